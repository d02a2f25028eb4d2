#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/atmosphere/sun_field_state.hpp"
#include "materials/atmosphere/two_stream.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double least_cosine = 0.01;

}  // namespace

ScaledAerosol scaled_aerosol(const Medium& medium, double height_km) {
    ScaledAerosol s{
        .extinction = {}, .scattering = {}, .asymmetry = {}, .whole = medium.scatterers(height_km)};
    const std::size_t count = s.whole.rayleigh.size();
    s.extinction.resize(count);
    s.scattering.resize(count);
    s.asymmetry.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double g = s.whole.asymmetry[i], peak = g * g;
        s.extinction[i] = s.whole.aerosol_extinction[i] - peak * s.whole.aerosol_scattering[i];
        s.scattering[i] = s.whole.aerosol_scattering[i] * (1.0 - peak);
        s.asymmetry[i] = g / (1.0 + g);
    }
    return s;
}

void LevelCurves::find_slopes(std::span<const double> level_km) {
    const std::size_t levels = value.size(), columns = value.front().size();
    slope.assign(levels, std::vector<double>(columns));
    std::vector<double> column(levels);
    for (std::size_t c = 0; c < columns; ++c) {
        for (std::size_t i = 0; i < levels; ++i) column[i] = value[i][c];
        const std::vector<double> slopes = monotone_slopes(level_km, column);
        for (std::size_t i = 0; i < levels; ++i) slope[i][c] = slopes[i];
    }
}

void SunField::State::fill_levels(const Medium& medium) {
    std::vector<std::vector<double>> beam;  // (level)(bin) scaled direct irradiance, clear sky
    follow_beam(medium, beam);
    spread_light(medium, beam);
}

void SunField::State::follow_beam(const Medium& medium, std::vector<std::vector<double>>& beam) {
    const std::size_t levels = level.size(), count = bins.size();
    std::vector<Amounts> to_sun(levels, medium.none());
    beam.assign(levels, std::vector<double>(count, 0.0));
    peak.assign(levels, count);
    for (std::size_t i = 0; i < levels; ++i) {
        const double z = level[i];
        lit.push_back(!ends_on_ground(model, z, sun.zenith_deg));
        if (!lit.back()) continue;
        if (z < atmosphere_top_km) {
            constexpr double no_end = std::numeric_limits<double>::infinity();
            const SightLine line = line_of(model, z, sun.zenith_deg, no_end, beam_segmentation);
            for (std::size_t s = 0; s < line.size(); ++s) {
                const ScaledAerosol here = scaled_aerosol(medium, line.height_km[s]);
                medium.add(line.height_km[s], line.length_km[s], here.extinction, to_sun[i]);
                for (std::size_t b = 0; b < count; ++b) {
                    peak.value[i][b] += line.length_km[s] * here.peak(b);
                }
            }
        }
        medium.transmittances(to_sun[i], beam[i]);
        for (std::size_t b = 0; b < count; ++b) beam[i][b] *= above_air[b];
    }
    const std::size_t gases = to_sun.front().gas.size();
    ln_amount.assign(levels, gases + to_sun.front().linear.size());
    aerosol.assign(levels, to_sun.front().aerosol.size());
    const auto lowest =
        static_cast<std::size_t>(std::find(lit.begin(), lit.end(), true) - lit.begin());
    for (std::size_t i = 0; i < levels; ++i) {
        const std::size_t from = std::max(i, std::min(lowest, levels - 1));
        const Amounts& met = to_sun[from];
        // The top has nothing above it: a thousandth of the level below stands for none.
        const auto ln = [&](std::size_t k, double amount) {
            const double below = i > 0 ? ln_amount.value[i - 1][k] : -700.0;
            return std::max(std::log(std::max(amount, 1e-304)), below - std::log(1e3));
        };
        for (std::size_t k = 0; k < gases; ++k) ln_amount.value[i][k] = ln(k, met.gas[k]);
        for (std::size_t k = 0; k < met.linear.size(); ++k) {
            ln_amount.value[i][gases + k] = ln(gases + k, met.linear[k]);
        }
        aerosol.value[i] = met.aerosol;
        if (from != i) peak.value[i] = peak.value[from];
    }
    for (LevelCurves* curves : {&ln_amount, &aerosol, &peak}) curves->find_slopes(level);
}

Amounts SunField::State::amounts_to_sun(const Medium& medium, const HermiteWeights& w) const {
    Amounts met = medium.none();
    const std::size_t gases = met.gas.size();
    for (std::size_t k = 0; k < gases; ++k) met.gas[k] = std::exp(ln_amount.at(w, k));
    for (std::size_t k = 0; k < met.linear.size(); ++k) {
        met.linear[k] = std::exp(ln_amount.at(w, gases + k));
    }
    for (std::size_t b = 0; b < met.aerosol.size(); ++b) met.aerosol[b] = aerosol.at(w, b);
    return met;
}

void SunField::State::spread_light(const Medium& medium,
                                   const std::vector<std::vector<double>>& beam) {
    const std::size_t levels = level.size(), count = bins.size();
    std::vector<std::vector<double>> absorption(levels, std::vector<double>(count, 1.0));
    Amounts above = medium.none();
    const std::vector<double> no_aerosol(count, 0.0);
    for (std::size_t i = levels - 1; i-- > 0;) {
        // Finer than the layers, so that amounts follow the profile.
        constexpr int cuts = 4;
        const double step = (level[i + 1] - level[i]) / cuts;
        for (int k = 0; k < cuts; ++k) {
            medium.add(level[i] + (k + 0.5) * step, step, no_aerosol, above);
        }
        medium.absorption_transmittances(above, absorption[i]);
    }
    // Mean extinction of a layer that thins exponentially is not that of its middle.
    std::vector<ScaledAerosol> edge, air;
    for (std::size_t i = 0; i < levels; ++i) edge.push_back(scaled_aerosol(medium, level[i]));
    for (std::size_t i = 0; i + 1 < levels; ++i) {
        air.push_back(scaled_aerosol(medium, 0.5 * (level[i] + level[i + 1])));
    }
    const auto mean = [](double low, double middle, double high) {
        return (low + 4.0 * middle + high) / 6.0;
    };

    for (DiffuseField* field : {&clear, &cloudy}) {
        field->up.assign(levels, count);
        field->down.assign(levels, count);
    }
    cosine = std::cos(radians(sun.zenith_deg));
    const double mu = std::clamp(cosine, least_cosine, 1.0);
    const bool clouds = model.cloud.fraction > 0.0;
    beam_through_cloud = clouds ? std::exp(-model.cloud.optical_depth / mu) : 1.0;
    const double drops = model.cloud.optical_depth * (1.0 - cloud_peak);
    const std::size_t base = at_height(model.cloud.base_km).low;
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
            const double rayleigh =
                depth([&](const ScaledAerosol& s) { return s.whole.rayleigh[b]; });
            const double extinction =
                depth([&](const ScaledAerosol& s) { return s.extinction[b]; });
            const double scattering =
                depth([&](const ScaledAerosol& s) { return s.scattering[b]; });
            const double gas =
                std::log(std::max(absorption[i + 1][b], 1e-30) / std::max(absorption[i][b], 1e-30));
            const double total = std::max(1e-12, rayleigh + extinction + std::max(0.0, gas));
            const double both = rayleigh + scattering;
            const double g = both > 0.0 ? scattering * air[i].asymmetry[b] / both : 0.0;
            layers.push_back({total, std::min(1.0, both / total), g, beam[i + 1][b], beam[i][b]});
            if (!clouds) continue;
            ScatteringLayer below = layers.back();
            if (i == base) {
                const double sum = both + 0.9995 * drops;
                below.asymmetry =
                    (both * g + drops * cloud_asymmetry / (1.0 + cloud_asymmetry)) / sum;
                below.depth = total + drops;
                below.single_albedo = sum / below.depth;
                below.beam_out *= std::exp(-drops / mu);
            } else if (i < base) {
                below.beam_in *= std::exp(-drops / mu);
                below.beam_out *= std::exp(-drops / mu);
            }
            covered.push_back(below);
        }
        const auto store = [&](const std::vector<ScatteringLayer>& of, DiffuseField& field) {
            const DiffuseFlux flux = two_stream(of, mu, sun.ground_albedo);
            for (std::size_t i = 0; i < levels; ++i) {
                field.up.value[levels - 1 - i][b] = std::max(0.0, flux.up[i]);
                field.down.value[levels - 1 - i][b] = std::max(0.0, flux.down[i]);
            }
        };
        store(layers, clear);
        if (clouds) store(covered, cloudy);
    }
    for (DiffuseField* field : {&clear, &cloudy}) {
        field->up.find_slopes(level);
        field->down.find_slopes(level);
    }
}

}  // namespace diurna
