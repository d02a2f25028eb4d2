#include "materials/matter/broadband.hpp"

#include <algorithm>

#include "materials/base/data_folder.hpp"
#include "materials/radiation/band.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

const Spectrum& sun_at_ground() {
    static const Spectrum sun =
        read_spectrum(data_folder() / "atmosphere" / "sun_at_ground.csv", 0.0);
    return sun;
}

}  // namespace

double solar_mean(const Spectrum& s) { return weighted_mean(s, sun_at_ground()); }

double solar_share(double from_um, double to_um) {
    return integral(sun_at_ground(), from_um, to_um) / integral(sun_at_ground());
}

double planck_mean(const Spectrum& s, double temperature) {
    if (s.value.size() < 2) return 0.0;
    const Band band = flat_band("", std::max(s.wavelength_um.front(), 0.2),
                                std::min(s.wavelength_um.back(), 100.0), s.wavelength_um);
    double sum = 0.0;
    for (std::size_t i = 0; i < band.node_um.size(); ++i) {
        sum += band.weight[i] * s.at(band.node_um[i]) * planck(band.node_um[i], temperature);
    }
    return sum / band_radiance(band, temperature);
}

}  // namespace diurna
