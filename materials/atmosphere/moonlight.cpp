#include "materials/atmosphere/moonlight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/spectrum.hpp"

namespace diurna {

double moon_over_sun(double wavelength_um, const MoonLight& moon) {
    if (!(moon.phase_deg >= 0.0 && moon.phase_deg <= 180.0)) {
        throw InputError("moon phase",
                         fmt::format("found {:g}°, expected 0 to 180", moon.phase_deg));
    }
    if (!(moon.distance_km > 340e3 && moon.distance_km < 420e3)) {
        throw InputError("moon distance",
                         fmt::format("found {:g} km, expected 340000 to 420000", moon.distance_km));
    }
    if (wavelength_um >= moonlight_ends_um) return 0.0;
    static const Spectrum colour{
        {0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.5},
        {0.70, 0.76, 0.84, 0.92, 1.0, 1.07, 1.13, 1.19, 1.28, 1.33, 1.38, 1.52, 1.66, 1.80, 1.90,
         2.00, 2.20}};
    const double phase = moon.phase_deg;
    const double magnitude = -12.73 + 0.026 * phase + 4e-9 * phase * phase * phase * phase;
    const double distance = 384400.0 / moon.distance_km;
    const double um = std::clamp(wavelength_um, 0.35, 2.5);
    return std::pow(10.0, -0.4 * (magnitude + 26.75)) * colour.at(um) * distance * distance /
           (moon.sun_distance_au * moon.sun_distance_au);
}

double lit_share(const MoonLight& moon) { return 0.5 + 0.5 * std::cos(radians(moon.phase_deg)); }

}  // namespace diurna
