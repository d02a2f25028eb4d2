#include "materials/atmosphere/scaled_aerosol.hpp"

namespace diurna {

ScaledAerosol scaled_aerosol(const Medium& medium, double height_km) {
    ScaledAerosol s{.extinction = {},
                    .scattering = {},
                    .asymmetry = {},
                    .whole = scatterers(medium, height_km)};
    const std::size_t count = s.whole.rayleigh.size();
    s.extinction.resize(count);
    s.scattering.resize(count);
    s.asymmetry.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double g = s.whole.asymmetry[i], peak = g * g;
        s.extinction[i] = s.whole.aerosol_extinction[i] - peak * s.whole.aerosol_scattering[i];
        s.scattering[i] = s.whole.aerosol_scattering[i] * (1.0 - peak);
        s.asymmetry[i] = g / (1.0 + g);
    }
    return s;
}

}  // namespace diurna
