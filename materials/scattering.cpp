#include "materials/scattering.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "materials/band_model_medium.hpp"
#include "materials/error.hpp"
#include "materials/planck.hpp"
#include "materials/two_stream.hpp"
#include "materials/units.hpp"

namespace diurna {

namespace {

/// Heights above the ground [km] between which the air is a plane layer.
constexpr std::array<double, 29> level_km = {0.0, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5,
                                             3.0, 4.0, 5.0,  6.0, 7.0,  8.0, 9.0,  10., 12., 14.,
                                             16., 18., 20.,  25., 30.,  40., 50.,  70., 100.};
constexpr std::size_t levels = level_km.size();
constexpr Segmentation beam_segments{
    .first_km = 0.05, .growth = 0.5, .ceiling_km = 0.5, .thinning_km = 8.0};
constexpr double least_cosine = 0.01;

/// The aerosol with the forward peak of its scattering counted as not scattered at all.
struct Scaled {
    std::vector<double> extinction;  // (bin) [km⁻¹] of aerosol
    std::vector<double> scattering;  // (bin) [km⁻¹] of aerosol
    std::vector<double> asymmetry;   // (bin)
    Scatterers whole;

    double peak(std::size_t bin) const { return whole.aerosol_extinction[bin] - extinction[bin]; }
};

Scaled scaled_at(const Medium& medium, double height_km) {
    Scaled s{
        .extinction = {}, .scattering = {}, .asymmetry = {}, .whole = medium.scatterers(height_km)};
    const std::size_t count = s.whole.rayleigh.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double g = s.whole.asymmetry[i], peak = g * g;
        s.extinction.push_back(s.whole.aerosol_extinction[i] -
                               peak * s.whole.aerosol_scattering[i]);
        s.scattering.push_back(s.whole.aerosol_scattering[i] * (1.0 - peak));
        s.asymmetry.push_back(g / (1.0 + g));
    }
    return s;
}

/// Two fluxes of a field at each level, (level)(bin).
struct Field {
    std::vector<std::vector<double>> up, down;
};

/// Index of the level at or below a height and the part of the way to the next.
std::pair<std::size_t, double> between_levels(const std::vector<double>& level, double height_km) {
    const double z = std::clamp(height_km, level.front(), level.back());
    std::size_t i = static_cast<std::size_t>(std::upper_bound(level.begin(), level.end() - 1, z) -
                                             level.begin());
    i = std::max<std::size_t>(i, 1) - 1;
    return {i, (z - level[i]) / (level[i + 1] - level[i])};
}

double henyey_greenstein(double g, double cosine) {
    const double d = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (d * std::sqrt(d));
}

}  // namespace

struct SunField::State {
    BandModel model;
    SunLight sun;
    BinRange bins;
    std::vector<std::size_t> node_bin;  // counted from the first of the range
    std::vector<double> above_air;  // (bin) irradiance [W m⁻² µm⁻¹] at the sun's distance
    std::vector<double> level;      // [km], ascending
    std::vector<bool> lit;          // (level)
    std::vector<Amounts> to_sun;    // (level), scaled aerosol
    /// Optical depth (level)(bin) that scaling took from the aerosol on the way to the sun.
    std::vector<std::vector<double>> peak_to_sun;
    std::vector<std::vector<double>> beam;  // (level)(bin) scaled direct irradiance, clear sky
    Field clear, cloudy;
    double beam_through_cloud = 1.0;
    double cosine = 0.0;

    void make_fields(const Medium& medium);
    Amounts amounts_to_sun(const Medium& medium, double height_km) const;
    std::vector<double> path(const SightLine& line, double zenith_deg, double azimuth_deg,
                             bool under_cloud, bool something_behind) const;
    std::vector<double> per_node(const std::vector<double>& per_bin) const {
        std::vector<double> values;
        values.reserve(node_bin.size());
        for (const std::size_t bin : node_bin) values.push_back(per_bin[bin]);
        return values;
    }
};

void SunField::State::make_fields(const Medium& medium) {
    const std::size_t count = bins.size();
    std::vector<std::vector<double>> absorption(levels, std::vector<double>(count));
    std::vector<Scaled> air;  // of the layer above each level
    Amounts above = medium.none();
    for (std::size_t i = levels - 1; i-- > 0;) {
        // Finer than the layers, so that amounts follow the profile.
        constexpr int cuts = 4;
        const double step = (level[i + 1] - level[i]) / cuts;
        for (int k = 0; k < cuts; ++k) {
            medium.add(level[i] + (k + 0.5) * step, step, std::vector<double>(count, 0.0), above);
        }
        medium.absorption_transmittances(above, absorption[i]);
    }
    std::fill(absorption[levels - 1].begin(), absorption[levels - 1].end(), 1.0);
    for (std::size_t i = 0; i < levels; ++i) {
        const double z = level[i];
        to_sun.push_back(medium.none());
        lit.push_back(!ends_on_ground(model, z, sun.zenith_deg));
        beam.emplace_back(count, 0.0);
        peak_to_sun.emplace_back(count, 0.0);
        if (!lit.back()) continue;
        if (z < atmosphere_top_km) {
            const SightLine line =
                model.refraction
                    ? refracted_line(model.profile, z, sun.zenith_deg,
                                     std::numeric_limits<double>::infinity(), beam_segments)
                    : sight_line(z, sun.zenith_deg, std::numeric_limits<double>::infinity(),
                                 beam_segments);
            for (std::size_t s = 0; s < line.size(); ++s) {
                const Scaled here = scaled_at(medium, line.height_km[s]);
                medium.add(line.height_km[s], line.length_km[s], here.extinction, to_sun.back());
                for (std::size_t b = 0; b < count; ++b) {
                    peak_to_sun.back()[b] += line.length_km[s] * here.peak(b);
                }
            }
        }
        medium.transmittances(to_sun.back(), beam.back());
        for (std::size_t b = 0; b < count; ++b) beam.back()[b] *= above_air[b];
    }
    for (std::size_t i = 0; i + 1 < levels; ++i) {
        air.push_back(scaled_at(medium, 0.5 * (level[i] + level[i + 1])));
    }
    // Mean extinction of a layer that thins exponentially is not that of its middle.
    std::vector<Scaled> edge;
    for (std::size_t i = 0; i < levels; ++i) edge.push_back(scaled_at(medium, level[i]));
    const auto mean = [](double low, double middle, double high) {
        return (low + 4.0 * middle + high) / 6.0;
    };

    for (Field* field : {&clear, &cloudy}) {
        field->up.assign(levels, std::vector<double>(count, 0.0));
        field->down = field->up;
    }
    cosine = std::cos(radians(sun.zenith_deg));
    const double mu = std::clamp(cosine, least_cosine, 1.0);
    const bool clouds = model.cloud.fraction > 0.0;
    beam_through_cloud = clouds ? std::exp(-model.cloud.optical_depth / mu) : 1.0;
    const auto [base, part] = between_levels(level, model.cloud.base_km);
    std::vector<ScatteringLayer> layers, covered;
    for (std::size_t b = 0; b < count; ++b) {
        if (!(above_air[b] > 0.0)) continue;
        layers.clear();
        covered.clear();
        for (std::size_t i = levels - 1; i-- > 0;) {  // from the top down
            const double thickness = level[i + 1] - level[i];
            const auto depth = [&](auto&& of) {
                return thickness * mean(of(edge[i]), of(air[i]), of(edge[i + 1]));
            };
            const double rayleigh = depth([&](const Scaled& s) { return s.whole.rayleigh[b]; });
            const double extinction = depth([&](const Scaled& s) { return s.extinction[b]; });
            const double scattering = depth([&](const Scaled& s) { return s.scattering[b]; });
            const double gas =
                std::log(std::max(absorption[i + 1][b], 1e-30) / std::max(absorption[i][b], 1e-30));
            const double total = std::max(1e-12, rayleigh + extinction + std::max(0.0, gas));
            const double both = rayleigh + scattering;
            const double g = both > 0.0 ? scattering * air[i].asymmetry[b] / both : 0.0;
            layers.push_back({total, std::min(1.0, both / total), g, beam[i + 1][b], beam[i][b]});
            if (!clouds) continue;
            ScatteringLayer below = layers.back();
            if (i == base) {
                // The drops of the cloud: g = 0.85, delta-scaled.
                constexpr double g_cloud = 0.85, peak = g_cloud * g_cloud;
                const double drops = model.cloud.optical_depth * (1.0 - peak);
                const double sum = both + 0.9995 * drops;
                below.asymmetry = (both * g + drops * g_cloud / (1.0 + g_cloud)) / sum;
                below.depth = total + drops;
                below.single_albedo = sum / below.depth;
                below.beam_out *= std::exp(-drops / mu);
            } else if (i < base) {
                const double scaled = model.cloud.optical_depth * (1.0 - 0.85 * 0.85);
                below.beam_in *= std::exp(-scaled / mu);
                below.beam_out *= std::exp(-scaled / mu);
            }
            covered.push_back(below);
        }
        const auto store = [&](const std::vector<ScatteringLayer>& of, Field& field) {
            const DiffuseFlux flux = two_stream(of, mu, sun.ground_albedo);
            for (std::size_t i = 0; i < levels; ++i) {
                field.up[levels - 1 - i][b] = std::max(0.0, flux.up[i]);
                field.down[levels - 1 - i][b] = std::max(0.0, flux.down[i]);
            }
        };
        store(layers, clear);
        if (clouds) store(covered, cloudy);
    }
}

Amounts SunField::State::amounts_to_sun(const Medium& medium, double height_km) const {
    const auto [i, t] = between_levels(level, height_km);
    if (!lit[i]) return lit[i + 1] ? to_sun[i + 1] : medium.none();
    Amounts between = to_sun[i];
    const auto exponential = [t = t](double low, double high) {
        return low > 0.0 && high > 0.0 ? low * std::exp(t * std::log(high / low))
                                       : low + t * (high - low);
    };
    const Amounts& above = to_sun[i + 1];
    for (std::size_t k = 0; k < between.gas.size(); ++k) {
        between.gas[k] = exponential(between.gas[k], above.gas[k]);
    }
    for (std::size_t k = 0; k < between.linear.size(); ++k) {
        between.linear[k] = exponential(between.linear[k], above.linear[k]);
    }
    for (std::size_t k = 0; k < between.aerosol.size(); ++k) {
        between.aerosol[k] += t * (above.aerosol[k] - between.aerosol[k]);
    }
    return between;
}

std::vector<double> SunField::State::path(const SightLine& line, double zenith_deg,
                                          double azimuth_deg, bool under_cloud,
                                          bool something_behind) const {
    const std::size_t count = bins.size();
    std::vector<double> radiance(count, 0.0);
    if (line.size() == 0) return per_node(radiance);
    const Medium medium(model, bins);
    const double view = std::cos(radians(zenith_deg)), sin_view = std::sin(radians(zenith_deg));
    // Light comes from the sun and goes on towards the eye: it turns by the angle between the
    // direction to the sun and that of the line.
    const double turn = std::clamp(view * cosine + sin_view * std::sin(radians(sun.zenith_deg)) *
                                                       std::cos(radians(azimuth_deg)),
                                   -1.0, 1.0);
    const double rayleigh_phase = 0.75 * (1.0 + turn * turn);
    const std::array<std::vector<double>, 3> phase = medium.phase(turn);
    const Field& field = under_cloud ? cloudy : clear;
    const double through = under_cloud ? beam_through_cloud : 1.0;

    // Few segments (level lines have one) are cut so that the product of both ways is followed.
    const int cuts = line.size() < 12 ? static_cast<int>(16 / line.size()) + 1 : 1;
    Amounts seen = medium.none();
    std::vector<double> peak_seen(count, 0.0);
    std::vector<double> single_before(count), single_after(count), tau_before(count, 1.0),
        tau_after(count);
    const auto beam_at = [&](double z, std::vector<double>& out) {
        const auto [i, t] = between_levels(level, z);
        if (!lit[i + 1] || (!lit[i] && t < 0.5)) {
            std::fill(out.begin(), out.end(), 0.0);
            return;
        }
        Amounts both = amounts_to_sun(medium, z);
        both.add(seen);
        medium.transmittances(both, out);
    };
    const auto height_after = [&](std::size_t segment, double share) {
        // Heights are known in the middle of segments; between them it is linear.
        const auto middle = [&](std::size_t k) { return line.height_km[k]; };
        if (line.size() == 1) return middle(0);
        const std::size_t a = share < 0.5 ? (segment > 0 ? segment - 1 : 0) : segment;
        const std::size_t b = std::min(a + 1, line.size() - 1);
        if (a == b) {
            const double slope =
                (middle(a) - middle(a - 1)) / (0.5 * (line.length_km[a] + line.length_km[a - 1]));
            return middle(a) + slope * (share - 0.5) * line.length_km[segment];
        }
        const double slope =
            (middle(b) - middle(a)) / (0.5 * (line.length_km[a] + line.length_km[b]));
        return middle(segment) + slope * (share - 0.5) * line.length_km[segment];
    };
    // Light of the forward peak that is scattered into it again is spread out: close to the sun the
    // peak is thinned by all extinction, far from it (where it is no peak) by the scaled one.
    const double angle_deg = degrees(std::acos(turn));
    const double wide = std::clamp((angle_deg - 20.0) / 40.0, 0.0, 1.0);
    beam_at(height_after(0, 0.0), single_before);
    for (std::size_t segment = 0; segment < line.size(); ++segment) {
        const double length = line.length_km[segment] / cuts;
        for (int cut = 0; cut < cuts; ++cut) {
            const double z = height_after(segment, (cut + 0.5) / cuts);
            const Scaled air = scaled_at(medium, z);
            medium.add(z, length, air.extinction, seen);
            beam_at(height_after(segment, (cut + 1.0) / cuts), single_after);
            medium.transmittances(seen, tau_after);
            const auto [i, t] = between_levels(level, z);
            for (std::size_t b = 0; b < count; ++b) {
                const double peak_half = 0.5 * length * air.peak(b);
                peak_seen[b] += 2.0 * peak_half;
                const double rayleigh = air.whole.rayleigh[b];
                // Transmittances fall exponentially within a segment, nearly.
                const auto mean = [](double before, double after) {
                    if (before + after < 1e-200) return 0.0;
                    before = std::max(before, 1e-200);
                    after = std::max(after, 1e-200);
                    const double ratio = after / before;
                    return ratio > 0.98 && ratio < 1.02 ? 0.5 * (before + after)
                                                        : (before - after) / -std::log(ratio);
                };
                double aerosol = 0.0;
                for (std::size_t k = 0; k < phase.size(); ++k) {
                    if (!air.whole.part[k].empty()) aerosol += air.whole.part[k][b] * phase[k][b];
                }
                double lobes = rayleigh * rayleigh_phase + aerosol;
                if (wide < 1.0 && aerosol > 0.0) {
                    const double smooth =
                        air.scattering[b] * henyey_greenstein(air.asymmetry[b], turn);
                    const double excess = (1.0 - wide) * std::max(0.0, aerosol - smooth);
                    const double depth = peak_seen[b] - peak_half + peak_to_sun[i][b] +
                                         t * (peak_to_sun[i + 1][b] - peak_to_sun[i][b]);
                    lobes += excess * std::expm1(-depth);
                }
                const double once = above_air[b] * through * lobes * 0.25 * std::numbers::inv_pi;
                const double up = field.up[i][b] + t * (field.up[i + 1][b] - field.up[i][b]);
                const double down =
                    field.down[i][b] + t * (field.down[i + 1][b] - field.down[i][b]);
                // Eddington's radiance, scattered: light that comes down the line moves at -view.
                const double mean_radiance = (up + down) * 0.5 * std::numbers::inv_pi;
                const double tilt = 0.75 * std::numbers::inv_pi * (up - down) * -view;
                const double often =
                    rayleigh * mean_radiance +
                    air.scattering[b] * std::max(0.0, mean_radiance + air.asymmetry[b] * tilt);
                radiance[b] += length * (once * mean(single_before[b], single_after[b]) +
                                         often * mean(tau_before[b], tau_after[b]));
            }
            single_before.swap(single_after);
            tau_before.swap(tau_after);
        }
    }
    if (something_behind) {
        // Whoever multiplies what is behind by the whole transmittance leaves out what its forward
        // peak brings: diffuse light of the end's own direction.
        const auto [i, t] = between_levels(level, line.height_km.back());
        for (std::size_t b = 0; b < count; ++b) {
            const double up = field.up[i][b] + t * (field.up[i + 1][b] - field.up[i][b]);
            const double down = field.down[i][b] + t * (field.down[i + 1][b] - field.down[i][b]);
            const double behind = std::max(
                0.0, std::numbers::inv_pi * (0.5 * (up + down) - 0.75 * (up - down) * view));
            radiance[b] += tau_before[b] * -std::expm1(-peak_seen[b]) * behind;
        }
    }
    return per_node(radiance);
}

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
    for (const double um : node_um) state->node_bin.push_back(bin_of(um) - state->bins.first);
    for (std::size_t b = state->bins.first; b < state->bins.last; ++b) {
        state->above_air.push_back(solar_above_air(bin_middles_um()[b]) /
                                   (sun.distance_au * sun.distance_au));
    }
    for (const double z : level_km) {
        // The highest levels stay; the lowest kilometres move up with the ground.
        state->level.push_back(z + model.ground_km * (1.0 - z / level_km.back()));
    }
    if (!node_um.empty()) state->make_fields(Medium(state->model, state->bins));
    state_ = std::move(state);
}

std::size_t SunField::nodes() const { return state_->node_bin.size(); }

std::vector<double> SunField::path(const SightLine& line, double zenith_deg,
                                   double azimuth_from_sun_deg) const {
    std::vector<double> radiance =
        state_->path(line, zenith_deg, azimuth_from_sun_deg, false, true);
    const double covered = state_->model.cloud.fraction;
    if (covered > 0.0) {
        const std::vector<double> under =
            state_->path(line, zenith_deg, azimuth_from_sun_deg, true, true);
        for (std::size_t i = 0; i < radiance.size(); ++i) {
            radiance[i] += covered * (under[i] - radiance[i]);
        }
    }
    return radiance;
}

std::vector<double> SunField::sky(double height_km, double zenith_deg,
                                  double azimuth_from_sun_deg) const {
    const BandModel& model = state_->model;
    const SightLine line = line_of(model, height_km, zenith_deg);
    const bool ground = ends_on_ground(model, height_km, zenith_deg);
    std::vector<double> radiance =
        state_->path(line, zenith_deg, azimuth_from_sun_deg, false, ground);
    const double covered = model.cloud.fraction;
    if (covered <= 0.0) return radiance;
    if (height_km >= model.cloud.base_km || ground) {
        return path(line, zenith_deg, azimuth_from_sun_deg);
    }
    SightLine below;
    for (std::size_t i = 0; i < line.size() && line.height_km[i] < model.cloud.base_km; ++i) {
        below.height_km.push_back(line.height_km[i]);
        below.length_km.push_back(line.length_km[i]);
    }
    const std::vector<double> under =
        state_->path(below, zenith_deg, azimuth_from_sun_deg, true, true);
    const std::vector<double> tau = transmittance(model, below, state_->bins);
    const auto [i, t] = between_levels(state_->level, model.cloud.base_km);
    for (std::size_t n = 0; n < radiance.size(); ++n) {
        const std::size_t b = state_->node_bin[n];
        const double base = state_->cloudy.down[i][b] * std::numbers::inv_pi;
        radiance[n] += covered * (under[n] + tau[b] * base - radiance[n]);
    }
    return radiance;
}

SunFlux SunField::flux(double height_km) const {
    const State& s = *state_;
    const auto [i, t] = between_levels(s.level, height_km);
    const std::size_t count = s.bins.size();
    std::vector<double> direct(count, 0.0), down(count), up(count);
    const double covered = s.model.cloud.fraction;
    const bool below = height_km < s.model.cloud.base_km;
    std::vector<double> scaled(count, 0.0);
    if (count > 0 && !ends_on_ground(s.model, height_km, s.sun.zenith_deg)) {
        const Medium medium(s.model, s.bins);
        direct = transmittance(s.model, line_of(s.model, height_km, s.sun.zenith_deg), s.bins);
        for (std::size_t b = 0; b < count; ++b) direct[b] *= s.above_air[b];
        if (s.lit[i] || t >= 0.5)
            medium.transmittances(s.amounts_to_sun(medium, height_km), scaled);
        for (std::size_t b = 0; b < count; ++b) {
            scaled[b] = std::max(scaled[b] * s.above_air[b], direct[b]);
        }
    }
    const double mu = std::max(0.0, s.cosine);
    const double scaled_through =
        std::exp(-s.model.cloud.optical_depth * (1.0 - 0.85 * 0.85) / std::max(mu, least_cosine));
    for (std::size_t b = 0; b < count; ++b) {
        const auto at = [&, i = i, t = t](const std::vector<std::vector<double>>& field) {
            return field[i][b] + t * (field[i + 1][b] - field[i][b]);
        };
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
