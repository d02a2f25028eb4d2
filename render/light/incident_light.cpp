#include "render/light/incident_light.hpp"

#include <algorithm>
#include <numbers>

namespace diurna {

LightByOrigin IncidentLight::sun_by_origin() const {
    LightByOrigin light;
    from(light, Origin::sunlight) = sun;
    return light;
}

LightByOrigin IncidentLight::sky_by_origin() const {
    LightByOrigin light;
    from(light, Origin::sunlight) = scattered;
    for (std::size_t n = 0; n < sky.size(); ++n) {
        from(light, Origin::sky_heat).push_back(sky_from(Origin::sky_heat, n));
    }
    return light;
}

std::optional<SunField> scattered_sun(const RadianceInput& input, std::span<const double> node_um) {
    const double no_sunlight_um = input.moon ? moonlight_ends_um : 5.0;
    const auto* model = std::get_if<BandModel>(&input.atmosphere);
    if (model == nullptr || input.sun_fraction.empty() || input.sun_zenith_deg >= 90.0 ||
        std::none_of(node_um.begin(), node_um.end(),
                     [&](double um) { return um < no_sunlight_um; })) {
        return std::nullopt;
    }
    return SunField(*model,
                    {.zenith_deg = input.sun_zenith_deg,
                     .distance_au = input.sun_distance_au,
                     .moon = input.moon},
                    node_um);
}

IncidentLight incident_light(const RadianceInput& input, double height_km,
                             std::span<const double> node_um, const SunField* scattered) {
    IncidentLight light{.sun = std::vector<double>(node_um.size(), 0.0),
                        .sky = mean_sky_at_nodes(input.atmosphere, height_km, node_um, 8),
                        .scattered = {}};
    if (!input.sun_fraction.empty()) {
        light.sun = solar_at_nodes(input.atmosphere, height_km, input.sun_zenith_deg,
                                   input.sun_distance_au, node_um);
    }
    for (std::size_t n = 0; input.moon && n < node_um.size(); ++n) {
        light.sun[n] *= moon_over_sun(node_um[n], *input.moon);
    }
    if (scattered != nullptr) {
        const SunFlux flux = scattered->flux(height_km);
        light.scattered.resize(node_um.size());
        for (std::size_t n = 0; n < node_um.size(); ++n) {
            light.scattered[n] = flux.down[n] * std::numbers::inv_pi;
            light.sky[n] += light.scattered[n];
        }
    }
    return light;
}

}  // namespace diurna
