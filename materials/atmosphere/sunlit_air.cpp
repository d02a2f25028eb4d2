#include "materials/atmosphere/sunlit_air.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "materials/atmosphere/beam_aerosol.hpp"
#include "materials/atmosphere/drop_absorption.hpp"
#include "materials/atmosphere/scaled_aerosol.hpp"
#include "materials/atmosphere/solar_spectrum.hpp"
#include "materials/atmosphere/two_stream.hpp"
#include "materials/base/error.hpp"
#include "materials/base/fast_exp.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// Heights above the ground [km] between which the air is a plane layer.
constexpr std::array<double, 29> level_km = {0.0, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5,
                                             3.0, 4.0, 5.0,  6.0, 7.0,  8.0, 9.0,  10., 12., 14.,
                                             16., 18., 20.,  25., 30.,  40., 50.,  70., 100.};
constexpr double least_cosine = 0.01;

using PerLevel = std::vector<std::vector<double>>;  // (level)(bin)

/// What each level's line to the sun has met, and the beam that is left there with the aerosol's
/// forward peak in it.
struct Beam {
    std::vector<Amounts> met;  // (level)
    PerLevel irradiance;       // clear sky
};

Beam follow_beam(SunlitAir& air, const Medium& medium) {
    const std::size_t levels = air.level.size(), count = air.bins.size();
    Beam beam{std::vector<Amounts>(levels, medium.none()),
              PerLevel(levels, std::vector<double>(count, 0.0))};
    air.peak.assign(levels, count);
    const std::vector<double> no_aerosol(count, 0.0);
    for (std::size_t i = 0; i < levels; ++i) {
        const double z = air.level[i];
        air.lit.push_back(!ends_on_ground(air.model, z, air.sun.zenith_deg));
        if (!air.lit.back()) continue;
        if (z < atmosphere_top_km) {
            constexpr double no_end = std::numeric_limits<double>::infinity();
            const SightLine line =
                line_of(air.model, z, air.sun.zenith_deg, no_end, beam_segmentation);
            BeamAerosol aerosol(medium);
            for (std::size_t s = 0; s < line.size(); ++s) {
                aerosol.add(line.height_km[s], line.length_km[s]);
                medium.add(line.height_km[s], line.length_km[s], no_aerosol, beam.met[i]);
            }
            aerosol.put(beam.met[i].aerosol, air.peak.value[i]);
        }
        medium.transmittances(beam.met[i], beam.irradiance[i]);
        for (std::size_t b = 0; b < count; ++b) beam.irradiance[i][b] *= air.above_air[b];
    }
    return beam;
}

/// Curves through what the lines to the sun have met.
void keep_amounts(SunlitAir& air, const std::vector<Amounts>& to_sun) {
    const std::size_t levels = air.level.size();
    const std::size_t gases = to_sun.front().gas.size();
    air.ln_amount.assign(levels, gases + to_sun.front().linear.size());
    air.aerosol.assign(levels, to_sun.front().aerosol.size());
    const auto lowest =
        static_cast<std::size_t>(std::find(air.lit.begin(), air.lit.end(), true) - air.lit.begin());
    for (std::size_t i = 0; i < levels; ++i) {
        const std::size_t from = std::max(i, std::min(lowest, levels - 1));
        const Amounts& met = to_sun[from];
        std::vector<std::vector<double>>& ln_amount = air.ln_amount.value;
        // The top has nothing above it: a thousandth of the level below represents none.
        const auto ln = [&](std::size_t k, double amount) {
            const double below = i > 0 ? ln_amount[i - 1][k] : -700.0;
            return std::max(std::log(std::max(amount, 1e-304)), below - std::log(1e3));
        };
        for (std::size_t k = 0; k < gases; ++k) ln_amount[i][k] = ln(k, met.gas[k]);
        for (std::size_t k = 0; k < met.linear.size(); ++k) {
            ln_amount[i][gases + k] = ln(gases + k, met.linear[k]);
        }
        air.aerosol.value[i] = met.aerosol;
        if (from != i) air.peak.value[i] = air.peak.value[from];
    }
    for (LevelCurves* curves : {&air.ln_amount, &air.aerosol, &air.peak}) {
        curves->find_slopes(air.level);
    }
}

/// Transmittance of gases and continua from the top of the air straight down to each level.
PerLevel absorption_above(const SunlitAir& air, const Medium& medium) {
    const std::size_t levels = air.level.size(), count = air.bins.size();
    PerLevel absorption(levels, std::vector<double>(count, 1.0));
    Amounts above = medium.none();
    const std::vector<double> no_aerosol(count, 0.0);
    for (std::size_t i = levels - 1; i-- > 0;) {
        // Finer than the layers, so that amounts follow the profile.
        constexpr int cuts = 4;
        const double step = (air.level[i + 1] - air.level[i]) / cuts;
        for (int k = 0; k < cuts; ++k) {
            medium.add(air.level[i] + (k + 0.5) * step, step, no_aerosol, above);
        }
        medium.absorption_transmittances(above, absorption[i]);
    }
    return absorption;
}

/// What the layers between levels hold. Mean extinction of a layer that thins exponentially is not
/// that of its middle: Simpson's rule.
LitLayers layers_of(const SunlitAir& air, const Medium& medium, PerLevel beam) {
    const std::size_t count = air.bins.size();
    const PerLevel absorption = absorption_above(air, medium);
    LitLayers layers{.content = {}, .beam = std::move(beam)};
    ScaledAerosol low = scaled_aerosol(medium, air.level[0]);
    for (std::size_t i = 0; i + 1 < air.level.size(); ++i) {
        const ScaledAerosol middle =
            scaled_aerosol(medium, 0.5 * (air.level[i] + air.level[i + 1]));
        ScaledAerosol high = scaled_aerosol(medium, air.level[i + 1]);
        const double thickness = air.level[i + 1] - air.level[i];
        const auto depth = [&](double a, double b, double c) {
            return thickness * ((a + 4.0 * b + c) / 6.0);
        };
        std::vector<LitLayers::Content>& content = layers.content.emplace_back();
        content.reserve(count);
        for (std::size_t b = 0; b < count; ++b) {
            const double rayleigh =
                depth(low.whole.rayleigh[b], middle.whole.rayleigh[b], high.whole.rayleigh[b]);
            const double extinction =
                depth(low.extinction[b], middle.extinction[b], high.extinction[b]);
            const double scattering =
                depth(low.scattering[b], middle.scattering[b], high.scattering[b]);
            const double gas =
                std::log(std::max(absorption[i + 1][b], 1e-30) / std::max(absorption[i][b], 1e-30));
            const double both = rayleigh + scattering;
            content.push_back({std::max(1e-12, rayleigh + extinction + std::max(0.0, gas)), both,
                               both > 0.0 ? scattering * middle.asymmetry[b] / both : 0.0});
        }
        low = std::move(high);
    }
    return layers;
}

ScatteringLayer clear_layer(const LitLayers& layers, std::size_t i, std::size_t b) {
    const LitLayers::Content& c = layers.content[i][b];
    return {c.depth, std::min(1.0, c.scattering / c.depth), c.asymmetry, layers.beam[i + 1][b],
            layers.beam[i][b]};
}

/// The clouds' drops in one bin.
struct Drops {
    double depth;   // scaled optical depth
    double albedo;  // scaled single-scattering albedo
    std::size_t layer;
};

/// A layer where clouds stand in it or above.
ScatteringLayer clouded_layer(const LitLayers& layers, std::size_t i, std::size_t b,
                              const Drops& drops, double mu) {
    const LitLayers::Content& c = layers.content[i][b];
    ScatteringLayer layer = clear_layer(layers, i, b);
    if (i == drops.layer) {
        const double scattered = drops.albedo * drops.depth, sum = c.scattering + scattered;
        layer.asymmetry =
            (c.scattering * c.asymmetry + scattered * cloud_asymmetry / (1.0 + cloud_asymmetry)) /
            sum;
        layer.depth = c.depth + drops.depth;
        layer.single_albedo = sum / layer.depth;
        layer.beam_out *= std::exp(-drops.depth / mu);
    } else if (i < drops.layer) {
        layer.beam_in *= std::exp(-drops.depth / mu);
        layer.beam_out *= std::exp(-drops.depth / mu);
    }
    return layer;
}

/// Where the beam is scattered.
double beam_cosine(const SunlitAir& air) { return std::clamp(air.cosine, least_cosine, 1.0); }

/// Two streams of every bin into the fluxes at levels.
///
/// - layer: layer(i, b)
template <class Layer>
DiffuseField diffuse_field(const SunlitAir& air, const Layer& layer) {
    const std::size_t levels = air.level.size(), count = air.bins.size();
    DiffuseField field;
    field.up.assign(levels, count);
    field.down.assign(levels, count);
    std::vector<ScatteringLayer> layers;
    for (std::size_t b = 0; b < count; ++b) {
        if (!(air.above_air[b] > 0.0)) continue;
        layers.clear();
        for (std::size_t i = levels - 1; i-- > 0;) layers.push_back(layer(i, b));  // from the top
        const DiffuseFlux flux = two_stream(layers, beam_cosine(air), air.sun.ground_albedo);
        for (std::size_t i = 0; i < levels; ++i) {
            field.up.value[levels - 1 - i][b] = std::max(0.0, flux.up[i]);
            field.down.value[levels - 1 - i][b] = std::max(0.0, flux.down[i]);
        }
    }
    field.up.find_slopes(air.level);
    field.down.find_slopes(air.level);
    return field;
}

void spread_under_cloud(SunlitAir& air) {
    const CloudLayer& cloud = air.model.cloud;
    air.cloudy = {};
    air.beam_through_cloud = 1.0;
    if (!(cloud.over_sun() > 0.0)) return;
    const double mu = beam_cosine(air);
    air.beam_through_cloud = std::exp(-cloud.optical_depth / mu);
    const std::size_t layer = air.at_height(cloud.base_km).low;
    std::vector<Drops> drops;  // (bin)
    for (std::size_t b = air.bins.first; b < air.bins.last; ++b) {
        const double albedo = std::min(0.9999, drop_single_albedo(bin_middles_um()[b]));
        const double left = 1.0 - cloud_peak * albedo;
        drops.push_back({cloud.optical_depth * left, (1.0 - cloud_peak) * albedo / left, layer});
    }
    air.cloudy = diffuse_field(air, [&](std::size_t i, std::size_t b) {
        return clouded_layer(*air.layers, i, b, drops[b], mu);
    });
}

}  // namespace

std::vector<double> SunlitAir::per_node(const std::vector<double>& per_bin) const {
    std::vector<double> values(node_bin.size());
    for (std::size_t n = 0; n < values.size(); ++n) {
        values[n] = node_share[n] * per_bin[node_bin[n]];
    }
    return values;
}

SunlitAir sunlit_air(const BandModel& model, const SunLight& sun, std::span<const double> node_um) {
    check_within("sun zenith angle", sun.zenith_deg, 0.0, 180.0);
    check_within("sun distance", sun.distance_au, 0.1, 100.0);
    check_within("ground albedo", sun.ground_albedo, 0.0, 1.0);
    check(model);
    SunlitAir air;
    air.model = model;
    air.sun = sun;
    air.bins = bins_of(node_um);
    for (const std::size_t bin : bin_of_each(node_um)) {
        const double um = node_um[air.node_bin.size()];
        air.node_bin.push_back(bin - air.bins.first);
        // Not 1 for the moon, and for the sun below 0.351 µm.
        air.node_share.push_back(solar_above_air(um) / solar_above_air(bin_middles_um()[bin]));
        if (sun.moon) air.node_share.back() *= moon_over_sun(um, *sun.moon);
    }
    for (std::size_t b = air.bins.first; b < air.bins.last; ++b) {
        air.above_air.push_back(solar_above_air(bin_middles_um()[b]) /
                                (sun.distance_au * sun.distance_au));
    }
    for (const double z : level_km) {
        // The highest levels stay; the lowest kilometres move up with the ground.
        air.level.push_back(z + model.ground_km * (1.0 - z / level_km.back()));
    }
    air.cosine = std::cos(radians(sun.zenith_deg));
    if (node_um.empty()) return air;
    const Medium medium(air.model, air.bins);
    Beam beam = follow_beam(air, medium);
    keep_amounts(air, beam.met);
    air.layers =
        std::make_shared<const LitLayers>(layers_of(air, medium, std::move(beam.irradiance)));
    air.clear = diffuse_field(
        air, [&](std::size_t i, std::size_t b) { return clear_layer(*air.layers, i, b); });
    spread_under_cloud(air);
    return air;
}

SunlitAir sunlit_air_under(SunlitAir air, const CloudLayer& cloud) {
    air.model.cloud = cloud;
    check(air.model);
    if (air.layers) spread_under_cloud(air);
    return air;
}

Amounts amounts_to_sun(const SunlitAir& air, const Medium& medium, const HermiteWeights& height) {
    Amounts met = medium.none();
    const std::size_t gases = met.gas.size();
    for (std::size_t k = 0; k < gases; ++k) met.gas[k] = fast_exp(air.ln_amount.at(height, k));
    for (std::size_t k = 0; k < met.linear.size(); ++k) {
        met.linear[k] = fast_exp(air.ln_amount.at(height, gases + k));
    }
    for (std::size_t b = 0; b < met.aerosol.size(); ++b) {
        met.aerosol[b] = air.aerosol.at(height, b);
    }
    return met;
}

}  // namespace diurna
