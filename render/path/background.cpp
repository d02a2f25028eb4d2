#include "render/path/background.hpp"

#include <algorithm>
#include <cmath>

#include "materials/air/sight_line.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/far_ground.hpp"
#include "render/light/radiance.hpp"

namespace diurna {

double horizon_zenith_deg(const RadianceInput& input, double height_km) {
    const double plain = earth_radius_km + input.plain_height_km();
    const double eye = earth_radius_km + height_km;
    return eye <= plain ? 90.0 : 180.0 - degrees(std::asin(plain / eye));
}

namespace {

/// Range [km] of the nearer crossing of a ray with the sphere of the plain.
double range_to_plain(const RadianceInput& input, double height_km, double zenith_deg) {
    const double plain = earth_radius_km + input.plain_height_km();
    const double eye = earth_radius_km + height_km;
    const double cosine = std::cos(radians(zenith_deg));
    const double square = (plain - eye) * (plain + eye) + eye * eye * cosine * cosine;
    return std::max(0.0, -eye * cosine - std::sqrt(std::max(0.0, square)));
}

}  // namespace

std::vector<double> background_at(const RadianceInput& input, double height_km, double zenith_deg,
                                  std::span<const double> node_um, const SightLine& onward,
                                  const LightByOrigin& far, const OnwardLight* from_plain) {
    if (zenith_deg <= horizon_zenith_deg(input, height_km)) {
        return sky_at_nodes(input.atmosphere, height_km, zenith_deg, node_um, onward);
    }
    const SightLine to_plain =
        chord(height_km, input.plain_height_km(), range_to_plain(input, height_km, zenith_deg));
    const SightLine line = joined(onward, to_plain);
    const std::vector<double>& sunlight = from(far, Origin::sunlight);
    PathSpectrum path;
    std::vector<double> share;  // of the plain's sunlight what arrives
    if (sunlight.empty()) {
        path = path_at_nodes(input.atmosphere, line, node_um);
    } else {
        OnwardLight::Way way = from_plain != nullptr ? from_plain->way(line)
                                                     : onward_from_plain(input, node_um).way(line);
        path = std::move(way.path);
        share = std::move(way.sunlight);
    }
    if (onward.size() > 0) {
        const PathSpectrum before = path_at_nodes(input.atmosphere, onward, node_um);
        for (std::size_t n = 0; n < node_um.size(); ++n) path.radiance[n] -= before.radiance[n];
    }
    if (!from(far, Origin::surface).empty()) {
        for (std::size_t n = 0; n < node_um.size(); ++n) {
            path.radiance[n] += path.transmittance[n] *
                                (from(far, Origin::surface)[n] + from(far, Origin::sky_heat)[n]);
            if (!sunlight.empty()) path.radiance[n] += share[n] * sunlight[n];
        }
        return std::move(path.radiance);
    }
    const double temperature = air_temperature_at(input.atmosphere, input.plain_height_km());
    for (std::size_t n = 0; n < node_um.size(); ++n) {
        path.radiance[n] += path.transmittance[n] * planck(node_um[n], temperature);
    }
    return std::move(path.radiance);
}

std::vector<std::vector<double>> scattered_backgrounds_at(
    const RadianceInput& input, const SunField& scattered, double height_km, double zenith_deg,
    std::span<const double> azimuth_from_sun_deg, const SightLine& onward) {
    if (zenith_deg <= horizon_zenith_deg(input, height_km)) {
        return scattered.skies(height_km, zenith_deg, azimuth_from_sun_deg, onward);
    }
    std::vector<double> angle_deg;
    for (const double azimuth : azimuth_from_sun_deg) {
        angle_deg.push_back(scattered.angle_from_sun_deg(zenith_deg, azimuth));
    }
    SunField::ByTurn light = scattered.path_by_turn(
        chord(height_km, input.plain_height_km(), range_to_plain(input, height_km, zenith_deg)),
        angle_deg, onward);
    const double cosine = std::cos(radians(zenith_deg));
    for (std::vector<double>& radiance : light.at_angle) {
        for (std::size_t n = 0; n < radiance.size(); ++n) {
            radiance[n] += cosine * light.by_cosine[n];
        }
    }
    return std::move(light.at_angle);
}

}  // namespace diurna
