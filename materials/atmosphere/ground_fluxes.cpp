#include "materials/atmosphere/ground_fluxes.hpp"

#include <numbers>

#include "materials/radiation/planck.hpp"

namespace diurna {

GroundFluxes ground_sunlight(const Atmosphere& atmosphere, const SunLight& sun, double height_km) {
    static const Band solar = flat_band("sun", 0.3, 5.0, bin_edges_um(), 1);
    GroundFluxes fluxes;
    if (const auto* model = std::get_if<BandModel>(&atmosphere)) {
        const SunFlux flux = SunField(*model, sun, solar.node_um).flux(height_km);
        fluxes.sun_direct = band_sum_nodes(solar, flux.direct);
        fluxes.sun_diffuse = band_sum_nodes(solar, flux.down);
    } else {
        fluxes.sun_direct = band_sum_nodes(
            solar,
            solar_at_nodes(atmosphere, height_km, sun.zenith_deg, sun.distance_au, solar.node_um));
    }
    return fluxes;
}

double ground_longwave(const Atmosphere& atmosphere, double height_km) {
    static const Band thermal = flat_band("thermal", 3.5, 100.0, bin_edges_um(), 2);
    std::vector<double> sky = mean_sky_at_nodes(atmosphere, height_km, thermal.node_um, 4);
    if (const auto* model = std::get_if<BandModel>(&atmosphere)) {
        // Water's rotation band: beyond 28 µm a hundred metres of air are black.
        const double near_by = air_at(model->profile, height_km).temperature;
        for (std::size_t n = 0; n < sky.size(); ++n) {
            if (thermal.node_um[n] > 28.0) sky[n] = planck(thermal.node_um[n], near_by);
        }
    }
    return std::numbers::pi * band_sum_nodes(thermal, sky);
}

GroundFluxes ground_fluxes(const Atmosphere& atmosphere, const SunLight& sun, double height_km) {
    GroundFluxes fluxes = ground_sunlight(atmosphere, sun, height_km);
    fluxes.thermal = ground_longwave(atmosphere, height_km);
    return fluxes;
}

}  // namespace diurna
