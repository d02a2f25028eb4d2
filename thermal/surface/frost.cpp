#include "thermal/surface/frost.hpp"

#include <algorithm>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/base/units.hpp"
#include "thermal/surface/stored_flux.hpp"

namespace diurna {

LatentHeat latent_heat_or_frost(const AirFilm& air, const Film& film, double wetness,
                                double resistance, double temperature) {
    const double of_ice = ice_over_water(air.air_temperature);
    const FrostVapour vapour = frost_vapour(air, air.latent, of_ice, temperature);
    const SurfaceFlux latent = latent_of(air, film, vapour, wetness, resistance);
    return {latent.flux, latent.slope};
}

double latent_heat_of_sublimation(double temperature) {
    const double t = std::clamp(temperature - zero_celsius, -100.0, 0.0);
    return 2.8341e6 - 290.0 * t - 4.0 * t * t;
}

double ice_over_water(double air_temperature) {
    return latent_heat_of_sublimation(air_temperature) /
           latent_heat_of_vaporisation(air_temperature);
}

double heat_of_vapour(double air_temperature, double surface_temperature) {
    const double frozen = frozen_share(surface_temperature);
    return std::lerp(latent_heat_of_vaporisation(air_temperature),
                     latent_heat_of_sublimation(air_temperature), frozen);
}

}  // namespace diurna
