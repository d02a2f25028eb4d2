#include "render/light/incident_at_heights.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

constexpr double straight_km = 0.03;
constexpr double same_km = 1e-4;

std::vector<double> mixed(const std::vector<double>& a, const std::vector<double>& b,
                          double share) {
    std::vector<double> sum(a.size());
    for (std::size_t n = 0; n < a.size(); ++n) sum[n] = std::lerp(a[n], b[n], share);
    return sum;
}

/// The light at a height between two.
IncidentLight between(const IncidentLight& a, const IncidentLight& b, double share) {
    IncidentLight light{.sun = mixed(a.sun, b.sun, share),
                        .sky = mixed(a.sky, b.sky, share),
                        .scattered = mixed(a.scattered, b.scattered, share),
                        .aureole = mixed(a.aureole, b.aureole, share)};
    for (std::size_t k = 0; k < light.uneven_heat.size(); ++k) {
        light.uneven_heat[k] = mixed(a.uneven_heat[k], b.uneven_heat[k], share);
    }
    for (std::size_t k = 0; k < light.uneven_scattered.size(); ++k) {
        light.uneven_scattered[k] = mixed(a.uneven_scattered[k], b.uneven_scattered[k], share);
    }
    for (std::size_t k = 0; k < a.left_scattered.size(); ++k) {
        light.left_scattered.push_back(mixed(a.left_scattered[k], b.left_scattered[k], share));
    }
    return light;
}

}  // namespace

std::array<IncidentLight, 3> incident_at_heights(const RadianceInput& input,
                                                 const HeightsLit& height_km,
                                                 std::span<const double> node_um,
                                                 const ScatteredSun* scattered) {
    std::array<IncidentLight, 3> light;
    const double span = height_km[2] - height_km[0];
    const bool one = span <= 0.0, straight = span < straight_km;
    for_each_index(
        light.size(),
        [&](std::size_t h) {
            if ((one && h > 0) || (straight && h == 1)) return;
            light[h] = incident_light(input, height_km[h], node_um, scattered);
        },
        1);
    if (one) {
        light[1] = light[2] = light[0];
    } else if (straight) {
        light[1] = between(light[0], light[2], 0.5);
    }
    return light;
}

LightByOrigin far_ground_light(const RadianceInput& input, std::span<const double> node_um,
                               const HeightsLit& height_km,
                               const std::array<IncidentLight, 3>& incident,
                               const ScatteredSun* scattered) {
    if (!input.beyond) return {};
    const double span = height_km[2] - height_km[0];
    const double above = input.beyond->height_km - height_km[0];
    if (span >= straight_km || above < -same_km || above > span + same_km) {
        return far_ground_light(input, node_um, scattered);
    }
    const double share = span > 0.0 ? std::clamp(above / span, 0.0, 1.0) : 0.0;
    return far_ground_light(input, node_um, between(incident[0], incident[2], share));
}

}  // namespace diurna
