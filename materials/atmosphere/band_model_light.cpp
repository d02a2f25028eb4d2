#include "materials/atmosphere/band_model_light.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/atmosphere/band_transmittance.hpp"
#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/cloud_on_line.hpp"
#include "materials/atmosphere/medium.hpp"
#include "materials/atmosphere/solar_spectrum.hpp"
#include "materials/base/fast_exp.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

/// Nodes with what does not depend on temperature worked out: Planck's law for many temperatures.
struct Nodes {
    std::vector<double> c1, c2;    // c₁ λ⁻⁵, c₂ / λ
    std::vector<std::size_t> bin;  // of the node, counted from the first of the range
    BinRange bins;

    explicit Nodes(std::span<const double> node_um)
        : bin(bin_of_each(node_um)), bins(bins_of(node_um)) {
        c1.reserve(node_um.size());
        c2.reserve(node_um.size());
        for (const double um : node_um) {
            c1.push_back(first_radiation_um / (um * um * um * um * um));
            c2.push_back(second_radiation_um / um);
        }
        for (std::size_t& b : bin) b -= bins.first;
    }
    std::size_t size() const { return bin.size(); }
};

/// Planck's law at the nodes. Air is no hotter than 1500 K, so that exp − 1 loses nothing below
/// 20 µm.
void black_bodies(const Nodes& nodes, double temperature, std::span<double> black) {
    const double inverse = 1.0 / temperature;
    const std::size_t count = nodes.size();
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) {
        black[i] = nodes.c1[i] / (fast_exp(nodes.c2[i] * inverse) - 1.0);
    }
}

/// (T39) of docs/theory.md
/// radiance += emission of one segment, Planck's law linear in optical depth x between its ends:
/// (near + (far − near) f) (τ_near − τ_far), f = 1/x − 1/(eˣ − 1) to 1 % of far − near.
///
/// - fraction, lost: (bin) f, and τ_near − τ_far
/// - gap: (node) what clouds before the segment let through
void add_emission(const Nodes& nodes, std::span<const double> near_black,
                  std::span<const double> far_black, std::span<const double> fraction,
                  std::span<const double> lost, std::span<const double> gap,
                  std::span<double> radiance) {
    const std::size_t count = radiance.size();
    const double *const near = near_black.data(), *const far = far_black.data(),
                        *const f = fraction.data(), *const drop = lost.data(),
                        *const open = gap.data();
    const std::size_t* const bin = nodes.bin.data();
    double* const sum = radiance.data();
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) {
        sum[i] += open[i] * ((near[i] + (far[i] - near[i]) * f[bin[i]]) * drop[bin[i]]);
    }
}

/// A path beyond a first part of it: its transmittance as a whole, and what of the light of the
/// rest arrives at its beginning.
PathSpectrum beyond(const BandModel& model, const SightLine& first, const SightLine& rest,
                    std::span<const double> node_um) {
    PathSpectrum path = band_model_path(model, joined(first, rest), node_um);
    if (first.size() > 0) {
        const PathSpectrum near = band_model_path(model, first, node_um);
        for (std::size_t i = 0; i < node_um.size(); ++i) path.radiance[i] -= near.radiance[i];
    }
    return path;
}

/// What a line of infinite range sees of the sky, as the model's air and cloud send it, or of the
/// ground.
std::vector<double> unscaled_sky(const BandModel& model, double height_km, double zenith_deg,
                                 std::span<const double> node_um, const SightLine& onward) {
    const bool ground = ends_on_ground(model, height_km, zenith_deg);
    const double behind = ground ? model.profile.temperature.front() : model.space_temperature;
    PathSpectrum path = beyond(model, onward, line_of(model, height_km, zenith_deg), node_um);
    for (std::size_t i = 0; i < node_um.size(); ++i) {
        path.radiance[i] += path.transmittance[i] * planck(node_um[i], behind);
    }
    return std::move(path.radiance);
}

/// A line with an edge wherever it meets the cloud.
struct CutLine {
    SightLine line;
    std::vector<std::pair<std::size_t, CloudCrossing>> cut;  // edge, and what is there
};

CutLine cut_at_clouds(const BandModel& model, const SightLine& line) {
    auto crossing = cloud_crossing(model, line);
    if (!crossing) return {line, {}};
    CutLine parts;
    SightLine rest = line;
    while (crossing) {
        parts.line = joined(parts.line, line_before(rest, *crossing));
        parts.cut.emplace_back(parts.line.size(), *crossing);
        rest = line_behind(rest, *crossing);
        // What begins at the cloud's side is behind it, not within.
        crossing = cloud_crossing(model, rest, 1);
    }
    parts.line = joined(parts.line, rest);
    return parts;
}

/// Puts a cloud between what is before an edge and all that comes after it.
///
/// - transmittance: (bin) of the air before the edge
void meet_cloud(const BandModel& model, const CloudCrossing& crossing,
                std::span<const double> node_um, const Nodes& nodes,
                std::span<const double> transmittance, std::vector<double>& gap,
                std::span<double> radiance) {
    for (std::size_t i = 0; i < node_um.size(); ++i) {
        const double hidden = hidden_share(model.cloud, crossing, node_um[i]);
        if (node_um[i] >= drops_scatter_um) {
            radiance[i] += hidden * gap[i] * transmittance[nodes.bin[i]] *
                           planck(node_um[i], crossing.temperature);
        }
        gap[i] *= 1.0 - hidden;
    }
}

}  // namespace

double scaled_sky(const LightScale& scale, double radiance, double black) {
    if (radiance < black) {
        radiance = black * -std::expm1(scale.sky_column * std::log1p(-radiance / black));
    }
    return scale.sky_heat * radiance;
}

/// A line that does not know its ends has in each segment the temperature of its middle.
PathSpectrum band_model_path(const BandModel& model, const SightLine& whole,
                             std::span<const double> node_um, Amounts* met) {
    const Nodes nodes(node_um);
    const std::size_t count = nodes.size();
    const Medium medium(model, nodes.bins);
    const CutLine parts = cut_at_clouds(model, whole);
    const SightLine& line = parts.line;
    auto cloud = parts.cut.begin();
    const bool ends_known = !line.edge_km.empty();
    const auto black_at = [&](double height_km, std::span<double> black) {
        black_bodies(nodes, pressure_and_temperature_at(model.profile, height_km).second, black);
    };
    const std::size_t bins = nodes.bins.size();
    std::vector<double> radiance(count, 0.0), gap(count, 1.0), near_black(count), far_black(count);
    std::vector<double> depth(bins, 0.0), tau(bins, 1.0), next_depth(bins), next_tau(bins),
        fraction(bins), lost(bins);
    if (ends_known) black_at(line.edge_km[0], near_black);
    Amounts amounts = medium.none();
    const auto meet_clouds = [&](std::size_t edge) {
        for (; cloud != parts.cut.end() && cloud->first == edge; ++cloud) {
            meet_cloud(model, cloud->second, node_um, nodes, tau, gap, radiance);
        }
    };
    const auto found = [&] {
        std::vector<double> transmittance(count);
        for (std::size_t i = 0; i < count; ++i) transmittance[i] = gap[i] * tau[nodes.bin[i]];
        return PathSpectrum{std::move(transmittance), std::move(radiance)};
    };
    for (std::size_t segment = 0; segment < line.size(); ++segment) {
        meet_clouds(segment);
        // Nothing beyond a full cloud cover is visible: it is not computed.
        if (met == nullptr &&
            std::all_of(gap.begin(), gap.end(), [](double g) { return g == 0.0; }))
            return found();
        medium.add(line, segment, amounts);
        medium.spread(amounts);
        medium.depths(amounts, next_depth);
        next_tau = next_depth;
        negative_exponentials(next_tau);
        for (std::size_t b = 0; b < bins; ++b) {
            const double x = next_depth[b] - depth[b];
            fraction[b] = (0.5 + 0.06 * x) / (1.0 + x * ((1.0 / 6.0 + 0.12) + 0.06 * x));
            lost[b] = tau[b] - next_tau[b];
        }
        black_at(ends_known ? line.edge_km[segment + 1] : line.height_km[segment], far_black);
        add_emission(nodes, ends_known ? near_black : far_black, far_black, fraction, lost, gap,
                     radiance);
        std::swap(near_black, far_black);
        std::swap(depth, next_depth);
        std::swap(tau, next_tau);
    }
    meet_clouds(line.size());
    if (met != nullptr) *met = std::move(amounts);
    return found();
}

std::vector<double> band_model_sky(const BandModel& model, double height_km, double zenith_deg,
                                   std::span<const double> node_um, const SightLine& onward) {
    std::vector<double> sky = unscaled_sky(model, height_km, zenith_deg, node_um, onward);
    const LightScale& scale = model.scale;
    const bool own = scale.sky_column == 1.0 && scale.sky_heat == 1.0;
    if (own || ends_on_ground(model, height_km, zenith_deg)) return sky;
    std::vector<double> here = sky;
    if (onward.size() > 0) here = unscaled_sky(model, height_km, zenith_deg, node_um, {});
    const double warm = air_at(model.profile, height_km).temperature;
    for (std::size_t i = 0; i < sky.size(); ++i) {
        if (!(here[i] > 0.0)) continue;
        sky[i] *= scaled_sky(scale, here[i], planck(node_um[i], warm)) / here[i];
    }
    return sky;
}

std::vector<double> band_model_sun(const BandModel& model, double height_km, double zenith_deg,
                                   std::span<const double> node_um, const SightLine& onward) {
    std::vector<double> irradiance(node_um.size(), 0.0);
    if (node_um.empty() || ends_on_ground(model, height_km, zenith_deg)) return irradiance;
    const BinRange bins = bins_of(node_um);
    const std::vector<double> tau =
        transmittance(model, joined(onward, line_of(model, height_km, zenith_deg)), bins);
    double clear = below_cloud(model, height_km) ? model.scale.beam : 1.0;
    if (below_cloud(model, height_km)) {
        const double mu = std::max(0.02, std::cos(radians(zenith_deg)));
        clear *= 1.0 - model.cloud.over_sun() * -std::expm1(-model.cloud.optical_depth / mu);
    }
    const std::vector<double> gap = through_clouds(model, onward, node_um);
    for (std::size_t i = 0; i < node_um.size(); ++i) {
        irradiance[i] =
            clear * gap[i] * solar_above_air(node_um[i]) * tau[bin_of(node_um[i]) - bins.first];
    }
    return irradiance;
}

}  // namespace diurna
