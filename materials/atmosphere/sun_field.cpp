#include "materials/atmosphere/sun_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/atmosphere/band_transmittance.hpp"
#include "materials/atmosphere/cloud_on_line.hpp"
#include "materials/atmosphere/sunlit_path.hpp"
#include "materials/base/units.hpp"

namespace diurna {

SunField::SunField(const BandModel& model, const SunLight& sun, std::span<const double> node_um)
    : air_(std::make_shared<const SunlitAir>(sunlit_air(model, sun, node_um))) {}

SunField SunField::under(const CloudLayer& cloud) const {
    return SunField(std::make_shared<const SunlitAir>(sunlit_air_under(*air_, cloud)));
}

std::vector<double> SunField::path(const SightLine& line, double zenith_deg,
                                   double azimuth_from_sun_deg) const {
    const auto turn = turns(air_->sun, zenith_deg, std::span(&azimuth_from_sun_deg, 1));
    const ScatteredLight light = scattered_light(*air_, line, turn);
    return air_->per_node(light.towards(0, std::cos(radians(zenith_deg))));
}

SunField::ByTurn SunField::path_by_turn(const SightLine& line, std::span<const double> angle_deg,
                                        const SightLine& onward) const {
    std::vector<double> turn;
    for (const double angle : angle_deg) turn.push_back(std::cos(radians(angle)));
    const ScatteredLight light = scattered_light(*air_, line, turn, onward);
    ByTurn parts;
    for (const auto& at_turn : light.at_turn) parts.at_angle.push_back(air_->per_node(at_turn));
    parts.by_cosine = air_->per_node(light.by_cosine);
    return parts;
}

double SunField::angle_from_sun_deg(double zenith_deg, double azimuth_from_sun_deg) const {
    return degrees(
        std::acos(turns(air_->sun, zenith_deg, std::span(&azimuth_from_sun_deg, 1)).front()));
}

std::vector<double> SunField::sky(double height_km, double zenith_deg,
                                  double azimuth_from_sun_deg) const {
    return std::move(skies(height_km, zenith_deg, std::span(&azimuth_from_sun_deg, 1)).front());
}

std::vector<std::vector<double>> SunField::skies(double height_km, double zenith_deg,
                                                 std::span<const double> azimuth_from_sun_deg,
                                                 const SightLine& onward) const {
    const SunlitAir& s = *air_;
    const CloudLayer& cloud = s.model.cloud;
    const SightLine line = line_of(s.model, height_km, zenith_deg);
    const bool ground = ends_on_ground(s.model, height_km, zenith_deg);
    const double cosine = std::cos(radians(zenith_deg));
    const auto turn = turns(s.sun, zenith_deg, azimuth_from_sun_deg);
    const double covered_share = cloud.over_sun();
    const bool over_cloud = covered_share > 0.0 && (!below_cloud(s.model, height_km) || ground);
    const ScatteredLight light = over_cloud ? scattered_light(s, line, turn, onward)
                                            : scattered_light(s, line, turn, false, ground, onward);
    std::vector<std::vector<double>> radiance;
    for (std::size_t a = 0; a < turn.size(); ++a) radiance.push_back(light.towards(a, cosine));
    if (covered_share > 0.0 && !over_cloud) {
        std::size_t below_base = 0;
        while (below_base < line.size() && line.height_km[below_base] < cloud.base_km) {
            ++below_base;
        }
        const SightLine below = line.first(below_base);
        const ScatteredLight covered = scattered_light(s, below, turn, true, true, onward);
        const std::vector<double> tau = transmittance(s.model, joined(onward, below), s.bins);
        const std::vector<double>& sent = s.cloudy.down.value[s.at_height(cloud.base_km).low];
        const double shape = base_brightness(cloud, cosine);
        for (std::size_t a = 0; a < turn.size(); ++a) {
            const std::vector<double> under = covered.towards(a, cosine);
            for (std::size_t b = 0; b < under.size(); ++b) {
                const double base = shape * sent[b] * std::numbers::inv_pi;
                radiance[a][b] += covered_share * (under[b] + tau[b] * base - radiance[a][b]);
            }
        }
    }
    const double scale =
        over_cloud || !below_cloud(s.model, height_km) ? 1.0 : s.model.scale.diffuse;
    for (std::vector<double>& of_azimuth : radiance) {
        of_azimuth = s.per_node(of_azimuth);
        for (double& value : of_azimuth) value *= scale;
    }
    return radiance;
}

SunFlux SunField::flux(double height_km) const {
    const SunlitAir& s = *air_;
    const double covered = s.model.cloud.over_sun();
    const bool below = below_cloud(s.model, height_km);
    const HermiteWeights w = s.at_height(height_km);
    const HermiteWeights clouded = covered > 0.0 ? in_clouded_air(s, height_km) : w;
    const std::size_t count = s.bins.size();
    std::vector<double> direct(count, 0.0), down(count), up(count);
    std::vector<double> scaled(count, 0.0);
    if (count > 0 && !ends_on_ground(s.model, height_km, s.sun.zenith_deg)) {
        const Medium medium(s.model, s.bins);
        direct = transmittance(s.model, line_of(s.model, height_km, s.sun.zenith_deg), s.bins);
        for (std::size_t b = 0; b < count; ++b) direct[b] *= s.above_air[b];
        if (s.sun_reaches(w)) medium.transmittances(amounts_to_sun(s, medium, w), scaled);
        for (std::size_t b = 0; b < count; ++b) {
            scaled[b] = std::max(scaled[b] * s.above_air[b], direct[b]);
        }
    }
    const double mu = std::max(0.0, s.cosine);
    const double scaled_through =
        std::exp(-s.model.cloud.optical_depth * (1.0 - cloud_peak) / std::max(mu, 0.01));
    for (std::size_t b = 0; b < count; ++b) {
        // What the scaling left in the beam is diffuse light around the sun.
        down[b] = (1.0 - covered) * (s.clear.down.at(w, b) + mu * (scaled[b] - direct[b]));
        up[b] = (1.0 - covered) * s.clear.up.at(w, b);
        double beam = (1.0 - covered) * direct[b];
        if (covered > 0.0) {
            const double through = below ? s.beam_through_cloud : 1.0;
            const double wide = below ? scaled_through : 1.0;
            down[b] += covered * (s.cloudy.down.at(clouded, b) +
                                  mu * (scaled[b] * wide - direct[b] * through));
            up[b] += covered * s.cloudy.up.at(clouded, b);
            beam += covered * direct[b] * through;
        }
        direct[b] = beam;
        if (!below) continue;
        direct[b] *= s.model.scale.beam;
        down[b] *= s.model.scale.diffuse;
        up[b] *= s.model.scale.diffuse;
    }
    return {s.per_node(direct), s.per_node(down), s.per_node(up)};
}

}  // namespace diurna
