#include <array>
#include <cmath>
#include <numbers>

#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

GroundFluxes ground_fluxes(const Atmosphere& atmosphere, const SunLight& sun, double height_km) {
    static const Band solar = flat_band("sun", 0.3, 5.0, bin_edges_um(), 1);
    static const Band thermal = flat_band("thermal", 3.5, 100.0, bin_edges_um(), 2);
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
    // ∫ L cosθ dΩ = π ∫₀¹ L d(cos²θ), Gauss-Legendre (Abramowitz & Stegun, table 25.4).
    constexpr std::array<double, 4> node = {0.06943184420297371, 0.33000947820757187,
                                            0.66999052179242813, 0.93056815579702629};
    constexpr std::array<double, 4> weight = {0.17392742256872693, 0.32607257743127307,
                                              0.32607257743127307, 0.17392742256872693};
    // Water's rotation band: beyond 28 µm a hundred metres of air are black.
    const auto* air = std::get_if<BandModel>(&atmosphere);
    const double near_by = air != nullptr ? air_at(air->profile, height_km).temperature : 0.0;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const double zenith_deg = degrees(std::acos(std::sqrt(node[i])));
        std::vector<double> sky = sky_at_nodes(atmosphere, height_km, zenith_deg, thermal.node_um);
        for (std::size_t n = 0; air != nullptr && n < sky.size(); ++n) {
            if (thermal.node_um[n] > 28.0) sky[n] = planck(thermal.node_um[n], near_by);
        }
        fluxes.thermal += std::numbers::pi * weight[i] * band_sum_nodes(thermal, sky);
    }
    return fluxes;
}

}  // namespace diurna
