#include "render/light/incident_light.hpp"

#include <algorithm>
#include <utility>

namespace diurna {

LightByOrigin IncidentLight::sun_by_origin() const {
    LightByOrigin light;
    for (std::size_t n = 0; n < sun.size(); ++n) {
        from(light, Origin::sunlight).push_back(from_sun(n));
    }
    return light;
}

LightByOrigin IncidentLight::sky_on(double sky_view, const UnevenView& uneven,
                                    std::span<const float> narrow) const {
    LightByOrigin light;
    for (const Origin origin : {Origin::sunlight, Origin::sky_heat}) {
        if (origin == Origin::sunlight && scattered.empty()) continue;
        for (std::size_t n = 0; n < sky.size(); ++n) {
            double sum = sky_view * sky_from(origin, n);
            for (std::size_t k = 0; k < uneven.size(); ++k) {
                sum += double{uneven[k]} * uneven_from(k, origin, n);
            }
            from(light, origin).push_back(sum);
        }
        if (origin != Origin::sunlight || narrow.empty()) continue;
        for (std::size_t i = 0; i < left_scattered.size(); ++i) {
            for (std::size_t n = 0; n < sky.size(); ++n) {
                from(light, origin)[n] += double{narrow[i]} * left_scattered[i][n];
            }
        }
    }
    return light;
}

bool has_scattered_sun(const RadianceInput& input, std::span<const double> node_um) {
    const double no_sunlight_um = input.moon ? moonlight_ends_um : 5.0;
    return std::holds_alternative<BandModel>(input.atmosphere) && !input.sun_fraction.empty() &&
           input.sun_zenith_deg < 90.0 &&
           std::any_of(node_um.begin(), node_um.end(),
                       [&](double um) { return um < no_sunlight_um; });
}

std::optional<ScatteredSun> scattered_sun(const RadianceInput& input,
                                          std::span<const double> node_um) {
    if (!has_scattered_sun(input, node_um)) return std::nullopt;
    return ScatteredSun(SunField(std::get<BandModel>(input.atmosphere),
                                 {.zenith_deg = input.sun_zenith_deg,
                                  .distance_au = input.sun_distance_au,
                                  .moon = input.moon},
                                 node_um),
                        input);
}

IncidentLight incident_light(const RadianceInput& input, double height_km,
                             std::span<const double> node_um, const ScatteredSun* scattered) {
    HeatOfSky heat = heat_of_sky(input.atmosphere, height_km, node_um);
    IncidentLight light{.sun = std::vector<double>(node_um.size(), 0.0),
                        .sky = std::move(heat.mean),
                        .scattered = {},
                        .uneven_heat = std::move(heat.uneven)};
    if (!input.sun_fraction.empty()) {
        light.sun = solar_at_nodes(input.atmosphere, height_km, input.sun_zenith_deg,
                                   input.sun_distance_au, node_um);
    }
    for (std::size_t n = 0; input.moon && n < node_um.size(); ++n) {
        light.sun[n] *= moon_over_sun(node_um[n], *input.moon);
    }
    if (scattered != nullptr) {
        const SunlitShape& shape = scattered->shape;
        const SunFlux flux = scattered->flux(height_km);
        light.scattered.resize(node_um.size());
        light.aureole.resize(node_um.size());
        for (std::vector<double>& c : light.uneven_scattered) c.resize(node_um.size());
        for (std::size_t n = 0; n < node_um.size(); ++n) {
            light.scattered[n] = flux.down[n] * shape.mean[n];
            light.aureole[n] = flux.down[n] * shape.aureole[n];
            light.sky[n] += light.scattered[n];
            for (std::size_t k = 0; k < uneven_functions; ++k) {
                light.uneven_scattered[k][n] = flux.down[n] * shape.uneven[k][n];
            }
        }
        light.left_scattered = shape.left;
        for (std::vector<double>& left : light.left_scattered) {
            for (std::size_t n = 0; n < node_um.size(); ++n) left[n] *= flux.down[n];
        }
    }
    return light;
}

}  // namespace diurna
