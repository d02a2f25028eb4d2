#include "materials/atmosphere/sun_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "materials/atmosphere/sun_field_state.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// Heights above the ground [km] between which the air is a plane layer.
constexpr std::array<double, 29> level_km = {0.0, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5,
                                             3.0, 4.0, 5.0,  6.0, 7.0,  8.0, 9.0,  10., 12., 14.,
                                             16., 18., 20.,  25., 30.,  40., 50.,  70., 100.};

}  // namespace

SunField::SunField(const BandModel& model, const SunLight& sun, std::span<const double> node_um) {
    const auto within = [](const char* what, double value, double least, double most) {
        if (!(value >= least && value <= most)) throw InputError(what, "out of its range");
    };
    within("sun zenith angle", sun.zenith_deg, 0.0, 180.0);
    within("sun distance", sun.distance_au, 0.1, 100.0);
    within("ground albedo", sun.ground_albedo, 0.0, 1.0);
    check(model);
    auto state = std::make_shared<State>();
    state->model = model;
    state->sun = sun;
    state->bins = bins_of(node_um);
    for (const double um : node_um) {
        state->node_bin.push_back(bin_of(um) - state->bins.first);
        state->node_share.push_back(solar_above_air(um) /
                                    solar_above_air(bin_middles_um()[bin_of(um)]));
    }
    for (std::size_t b = state->bins.first; b < state->bins.last; ++b) {
        state->above_air.push_back(solar_above_air(bin_middles_um()[b]) /
                                   (sun.distance_au * sun.distance_au));
    }
    for (const double z : level_km) {
        // The highest levels stay; the lowest kilometres move up with the ground.
        state->level.push_back(z + model.ground_km * (1.0 - z / level_km.back()));
    }
    if (!node_um.empty()) state->fill_levels(Medium(state->model, state->bins));
    state_ = std::move(state);
}

std::size_t SunField::nodes() const { return state_->node_bin.size(); }

std::vector<double> SunField::path(const SightLine& line, double zenith_deg,
                                   double azimuth_from_sun_deg) const {
    const auto turn = state_->turns(zenith_deg, std::span(&azimuth_from_sun_deg, 1));
    return state_->per_node(state_->mixed(line, turn).towards(0, std::cos(radians(zenith_deg))));
}

SunField::Apart SunField::path_apart(const SightLine& line,
                                     std::span<const double> angle_deg) const {
    std::vector<double> turn;
    for (const double angle : angle_deg) turn.push_back(std::cos(radians(angle)));
    const State::Scattered light = state_->mixed(line, turn);
    Apart apart;
    for (const auto& level : light.level) apart.at_angle.push_back(state_->per_node(level));
    apart.by_cosine = state_->per_node(light.by_cosine);
    return apart;
}

double SunField::angle_from_sun_deg(double zenith_deg, double azimuth_from_sun_deg) const {
    return degrees(
        std::acos(state_->turns(zenith_deg, std::span(&azimuth_from_sun_deg, 1)).front()));
}

std::vector<double> SunField::sky(double height_km, double zenith_deg,
                                  double azimuth_from_sun_deg) const {
    return std::move(skies(height_km, zenith_deg, std::span(&azimuth_from_sun_deg, 1)).front());
}

std::vector<std::vector<double>> SunField::skies(
    double height_km, double zenith_deg, std::span<const double> azimuth_from_sun_deg) const {
    const State& s = *state_;
    const CloudLayer& cloud = s.model.cloud;
    const SightLine line = line_of(s.model, height_km, zenith_deg);
    const bool ground = ends_on_ground(s.model, height_km, zenith_deg);
    const double cosine = std::cos(radians(zenith_deg));
    const auto turn = s.turns(zenith_deg, azimuth_from_sun_deg);
    const bool over_cloud = cloud.fraction > 0.0 && (height_km >= cloud.base_km || ground);
    const State::Scattered light =
        over_cloud ? s.mixed(line, turn) : s.along(line, turn, false, ground);
    std::vector<std::vector<double>> radiance;
    for (std::size_t a = 0; a < turn.size(); ++a) radiance.push_back(light.towards(a, cosine));
    if (cloud.fraction > 0.0 && !over_cloud) {
        std::size_t below_base = 0;
        while (below_base < line.size() && line.height_km[below_base] < cloud.base_km) {
            ++below_base;
        }
        const SightLine below = line.first(below_base);
        const State::Scattered covered = s.along(below, turn, true, true);
        const std::vector<double> tau = transmittance(s.model, below, s.bins);
        const HermiteWeights w = s.at_height(cloud.base_km);
        for (std::size_t a = 0; a < turn.size(); ++a) {
            const std::vector<double> under = covered.towards(a, cosine);
            for (std::size_t b = 0; b < under.size(); ++b) {
                const double base = s.cloudy.down.at(w, b) * std::numbers::inv_pi;
                radiance[a][b] += cloud.fraction * (under[b] + tau[b] * base - radiance[a][b]);
            }
        }
    }
    for (std::vector<double>& of_azimuth : radiance) of_azimuth = s.per_node(of_azimuth);
    return radiance;
}

SunFlux SunField::flux(double height_km) const {
    const State& s = *state_;
    const HermiteWeights w = s.at_height(height_km);
    const std::size_t count = s.bins.size();
    std::vector<double> direct(count, 0.0), down(count), up(count);
    const double covered = s.model.cloud.fraction;
    const bool below = height_km < s.model.cloud.base_km;
    std::vector<double> scaled(count, 0.0);
    if (count > 0 && !ends_on_ground(s.model, height_km, s.sun.zenith_deg)) {
        const Medium medium(s.model, s.bins);
        direct = transmittance(s.model, line_of(s.model, height_km, s.sun.zenith_deg), s.bins);
        for (std::size_t b = 0; b < count; ++b) direct[b] *= s.above_air[b];
        if (s.sun_reaches(w)) medium.transmittances(s.amounts_to_sun(medium, w), scaled);
        for (std::size_t b = 0; b < count; ++b) {
            scaled[b] = std::max(scaled[b] * s.above_air[b], direct[b]);
        }
    }
    const double mu = std::max(0.0, s.cosine);
    const double scaled_through =
        std::exp(-s.model.cloud.optical_depth * (1.0 - cloud_peak) / std::max(mu, 0.01));
    for (std::size_t b = 0; b < count; ++b) {
        const auto at = [&](const LevelCurves& field) { return field.at(w, b); };
        // What the scaling left in the beam is diffuse light around the sun.
        down[b] = (1.0 - covered) * (at(s.clear.down) + mu * (scaled[b] - direct[b]));
        up[b] = (1.0 - covered) * at(s.clear.up);
        double beam = (1.0 - covered) * direct[b];
        if (covered > 0.0) {
            const double through = below ? s.beam_through_cloud : 1.0;
            const double wide = below ? scaled_through : 1.0;
            down[b] +=
                covered * (at(s.cloudy.down) + mu * (scaled[b] * wide - direct[b] * through));
            up[b] += covered * at(s.cloudy.up);
            beam += covered * direct[b] * through;
        }
        direct[b] = beam;
    }
    return {s.per_node(direct), s.per_node(down), s.per_node(up)};
}

}  // namespace diurna
