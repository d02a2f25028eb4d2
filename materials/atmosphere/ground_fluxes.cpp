#include "materials/atmosphere/ground_fluxes.hpp"

#include <numbers>

#include "materials/radiation/planck.hpp"

namespace diurna {

const Band& sunlight_band() {
    static const Band band = flat_band("sun", 0.3, 5.0, bin_edges_um(), 1);
    return band;
}

const Band& longwave_band() {
    static const Band band = flat_band("thermal", 3.5, 100.0, bin_edges_um(), 2);
    return band;
}

GroundFluxes ground_sunlight(const SunField& sunlight, double height_km) {
    const SunFlux flux = sunlight.flux(height_km);
    return {.sun_direct = band_sum_nodes(sunlight_band(), flux.direct),
            .sun_diffuse = band_sum_nodes(sunlight_band(), flux.down)};
}

GroundFluxes ground_sunlight(const Atmosphere& atmosphere, const SunLight& sun, double height_km) {
    const Band& band = sunlight_band();
    if (const auto* model = std::get_if<BandModel>(&atmosphere)) {
        return ground_sunlight(SunField(*model, sun, band.node_um), height_km);
    }
    return {.sun_direct = band_sum_nodes(band, solar_at_nodes(atmosphere, height_km, sun.zenith_deg,
                                                              sun.distance_au, band.node_um))};
}

double ground_longwave(const Atmosphere& atmosphere, double height_km) {
    const Band& thermal = longwave_band();
    std::vector<double> sky = mean_sky_at_nodes(atmosphere, height_km, thermal.node_um, 4);
    if (const auto* model = std::get_if<BandModel>(&atmosphere)) {
        const double near_by = air_at(model->profile, height_km).temperature;
        for (std::size_t n = 0; n < sky.size(); ++n) {
            if (thermal.node_um[n] > black_air_um) sky[n] = planck(thermal.node_um[n], near_by);
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
