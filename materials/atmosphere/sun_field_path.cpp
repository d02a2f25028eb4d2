#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "materials/atmosphere/sun_field_state.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

double henyey_greenstein(double g, double cosine) {
    const double d = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (d * std::sqrt(d));
}

/// Mean over a stretch of a transmittance that falls exponentially, nearly.
double mean_between(double before, double after) {
    if (before + after < 1e-200) return 0.0;
    before = std::max(before, 1e-200);
    after = std::max(after, 1e-200);
    const double x = std::log(before / after);
    // (1 − e⁻ˣ) / x, by its series where it cancels.
    return std::abs(x) < 0.01 ? before * (1.0 - x * (0.5 - x * (1.0 / 6.0))) : (before - after) / x;
}

/// One direction to the sun: how the line turns its light.
struct Direction {
    double turn;  // cosine of the angle by which light turns
    /// Share of the forward peak that is spread out again: light of the peak that is scattered
    /// into it once more. Close to the sun the peak is thinned by all extinction, far from it
    /// (where it is no peak) by the scaled one.
    double peaked;
    std::array<std::vector<double>, 3> phase;  // of the parts of the aerosol, (bin)
    std::vector<double> excess;                // (bin) light the peak loses on its way
};

Direction direction_of(const Medium& medium, double turn) {
    Direction d;
    d.turn = turn;
    const double t = std::clamp((degrees(std::acos(d.turn)) - 20.0) / 40.0, 0.0, 1.0);
    d.peaked = 1.0 - t * t * (3.0 - 2.0 * t);
    d.phase = medium.phase(d.turn);
    d.excess.assign(medium.bins().size(), 0.0);
    return d;
}

}  // namespace

std::vector<double> SunField::State::turns(double zenith_deg,
                                           std::span<const double> azimuth_deg) const {
    // Light comes from the sun and goes on towards the eye: it turns by the angle between the
    // direction to the sun and that of the line.
    const double view = std::cos(radians(zenith_deg)), sin_view = std::sin(radians(zenith_deg));
    const double sun_up = std::cos(radians(sun.zenith_deg)),
                 sun_aside = std::sin(radians(sun.zenith_deg));
    std::vector<double> turn;
    for (const double azimuth : azimuth_deg) {
        const double turned = view * sun_up + sin_view * sun_aside * std::cos(radians(azimuth));
        turn.push_back(std::clamp(turned, -1.0, 1.0));
    }
    return turn;
}

SunField::State::Scattered SunField::State::along(const SightLine& line,
                                                  std::span<const double> turn, bool under_cloud,
                                                  bool something_behind) const {
    const std::size_t count = bins.size();
    Scattered result{std::vector<std::vector<double>>(turn.size(), std::vector<double>(count, 0.0)),
                     std::vector<double>(count, 0.0)};
    if (line.size() == 0 || count == 0) return result;
    const Medium medium(model, bins);
    std::vector<Direction> directions;
    for (const double angle_cosine : turn) {
        directions.push_back(direction_of(medium, angle_cosine));
    }
    const DiffuseField& field = under_cloud ? cloudy : clear;

    const bool any_peaked = std::any_of(directions.begin(), directions.end(),
                                        [](const Direction& d) { return d.peaked > 0.0; });
    // Few segments (level lines have one) are cut so that the product of both ways is followed.
    const int cuts = line.size() < 12 ? static_cast<int>(16 / line.size()) + 1 : 1;
    Amounts seen = medium.none();
    // Once-scattered light per phase function: ∫ scattering · transmittance of both ways ds.
    std::vector<double> by_air(count, 0.0), often(count, 0.0);
    std::array<std::vector<double>, 3> by_aerosol;
    std::vector<double> peak_seen(count, 0.0), single(count), thinned(count), single_before(count),
        single_after(count), tau_before(count, 1.0), tau_after(count);
    const auto beam_at = [&](double z, std::vector<double>& out) {
        const HermiteWeights w = at_height(z);
        if (!sun_reaches(w)) {
            std::fill(out.begin(), out.end(), 0.0);
            return;
        }
        Amounts both = amounts_to_sun(medium, w);
        both.add(seen);
        medium.transmittances(both, out);
    };
    beam_at(line.height_within(0, 0.0), single_before);
    for (std::size_t segment = 0; segment < line.size(); ++segment) {
        const double length = line.length_km[segment] / cuts;
        for (int cut = 0; cut < cuts; ++cut) {
            const double z = line.height_within(segment, (cut + 0.5) / cuts);
            const ScaledAerosol air = scaled_aerosol(medium, z);
            medium.add(z, length, air.extinction, seen);
            beam_at(line.height_within(segment, (cut + 1.0) / cuts), single_after);
            medium.transmittances(seen, tau_after);
            const HermiteWeights w = at_height(z);
            const double through =
                under_cloud && z < model.cloud.base_km ? beam_through_cloud : 1.0;
            for (std::size_t b = 0; b < count; ++b) {
                single[b] = through * length * mean_between(single_before[b], single_after[b]);
                by_air[b] += air.whole.rayleigh[b] * single[b];
                const double up = field.up.at(w, b), down = field.down.at(w, b);
                // Eddington's radiance, scattered: light that comes down the line moves against
                // it. Asymmetries are below a half, so that it is never negative.
                const double mean_radiance = (up + down) * 0.5 * std::numbers::inv_pi;
                const double tilt = 0.75 * std::numbers::inv_pi * (down - up);
                const double reach = length * mean_between(tau_before[b], tau_after[b]);
                often[b] += reach * (air.whole.rayleigh[b] + air.scattering[b]) * mean_radiance;
                result.by_cosine[b] += reach * air.scattering[b] * air.asymmetry[b] * tilt;
            }
            for (std::size_t k = 0; k < by_aerosol.size(); ++k) {
                const std::vector<double>& part = air.whole.part[k];
                if (part.empty()) continue;
                if (by_aerosol[k].empty()) by_aerosol[k].assign(count, 0.0);
                for (std::size_t b = 0; b < count; ++b) by_aerosol[k][b] += part[b] * single[b];
            }
            for (std::size_t b = 0; any_peaked && b < count; ++b) {
                const double before = std::exp(-peak_seen[b] - peak.at(w, b));
                const double after = before * std::exp(-length * air.peak(b));
                thinned[b] = through * length *
                             mean_between(single_before[b] * before, single_after[b] * after);
            }
            for (Direction& d : directions) {
                if (d.peaked <= 0.0) continue;
                for (std::size_t b = 0; b < count; ++b) {
                    double lobes = 0.0;
                    for (std::size_t k = 0; k < d.phase.size(); ++k) {
                        if (air.whole.part[k].empty()) continue;
                        lobes += air.whole.part[k][b] * d.phase[k][b];
                    }
                    if (lobes <= 0.0) continue;
                    const double smooth =
                        air.scattering[b] * henyey_greenstein(air.asymmetry[b], d.turn);
                    d.excess[b] += std::max(0.0, lobes - smooth) * (thinned[b] - single[b]);
                }
            }
            for (std::size_t b = 0; b < count; ++b) peak_seen[b] += length * air.peak(b);
            single_before.swap(single_after);
            tau_before.swap(tau_after);
        }
    }
    if (something_behind) {
        // Whoever multiplies what is behind by the whole transmittance leaves out what its forward
        // peak brings: diffuse light of the end's own direction.
        const HermiteWeights w = at_height(line.height_within(line.size() - 1, 1.0));
        for (std::size_t b = 0; b < count; ++b) {
            const double up = field.up.at(w, b), down = field.down.at(w, b);
            const double share =
                tau_before[b] * -std::expm1(-peak_seen[b]) * 0.5 * std::numbers::inv_pi;
            often[b] += share * (up + down);
            result.by_cosine[b] += share * (down - up);
        }
    }
    for (std::size_t a = 0; a < directions.size(); ++a) {
        const Direction& d = directions[a];
        const double rayleigh_phase = 0.75 * (1.0 + d.turn * d.turn);
        for (std::size_t b = 0; b < count; ++b) {
            double once = by_air[b] * rayleigh_phase + d.peaked * d.excess[b];
            for (std::size_t k = 0; k < by_aerosol.size(); ++k) {
                if (!by_aerosol[k].empty()) once += by_aerosol[k][b] * d.phase[k][b];
            }
            result.level[a][b] = above_air[b] * 0.25 * std::numbers::inv_pi * once + often[b];
        }
    }
    return result;
}

SunField::State::Scattered SunField::State::mixed(const SightLine& line,
                                                  std::span<const double> turn) const {
    Scattered light = along(line, turn, false, true);
    const double covered = model.cloud.fraction;
    if (covered <= 0.0) return light;
    const Scattered under = along(line, turn, true, true);
    const auto mix = [covered](std::vector<double>& clear_part, const std::vector<double>& other) {
        for (std::size_t b = 0; b < clear_part.size(); ++b) {
            clear_part[b] += covered * (other[b] - clear_part[b]);
        }
    };
    for (std::size_t a = 0; a < turn.size(); ++a) mix(light.level[a], under.level[a]);
    mix(light.by_cosine, under.by_cosine);
    return light;
}

}  // namespace diurna
