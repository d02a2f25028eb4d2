#include "render/band_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "materials/band_model.hpp"
#include "materials/planck.hpp"
#include "materials/units.hpp"
#include "render/radiance.hpp"
#include "terrain/parallel.hpp"

namespace diurna {

namespace {

/// Cubic through values and slopes (per cell) at 0 and 1, by rising power.
std::array<double, 4> hermite(double v0, double s0, double v1, double s1) {
    return {v0, s0, 3.0 * (v1 - v0) - 2.0 * s0 - s1, 2.0 * (v0 - v1) + s0 + s1};
}

/// Planck's law up to a factor common to all wavelengths, safe where B itself underflows.
double planck_shape(double wavelength_um, double longest_um, double temperature) {
    const double c = second_radiation_um / temperature;
    const double x = c / wavelength_um;
    return std::exp(c / longest_um - x) / -std::expm1(-x) / std::pow(wavelength_um, 5);
}

void evaluate_cubic(const float* cell, std::size_t padded, float t, float* out) {
    const float *a0 = cell, *a1 = a0 + padded, *a2 = a1 + padded, *a3 = a2 + padded;
#pragma omp simd
    for (std::size_t c = 0; c < padded; ++c) {
        out[c] = a0[c] + t * (a1[c] + t * (a2[c] + t * a3[c]));
    }
}

}  // namespace

Channels channels_of(const Band& band) {
    // Beyond the grid of bins one bin goes on for ever, so a channel ends after 5 % at the latest.
    constexpr double widest = 1.05;
    Channels channels;
    for (std::size_t n = 0; n < band.node_um.size(); ++n) {
        const bool starts = n == 0 || bin_of(band.node_um[n]) != bin_of(band.node_um[n - 1]) ||
                            band.node_um[n] > widest * band.node_um[channels.first.back()];
        if (starts) channels.first.push_back(static_cast<std::uint32_t>(n));
    }
    channels.first.push_back(static_cast<std::uint32_t>(band.node_um.size()));
    return channels;
}

std::vector<float> channel_sums(const Band& band, const Channels& channels,
                                std::span<const double> f, std::span<const double> g) {
    std::vector<float> sums(channels.padded(), 0.0f);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        double sum = 0.0;
        for (std::size_t n = channels.first[c]; n < channels.first[c + 1]; ++n) {
            sum += band.weight[n] * f[n] * g[n];
        }
        sums[c] = static_cast<float>(sum);
    }
    return sums;
}

TemperatureGrid temperature_grid(double low, double high) {
    assert(low > 0.0 && high >= low);
    TemperatureGrid grid;
    grid.cells = static_cast<std::size_t>(std::max(1.0, std::ceil((high - low) / 2.0)));
    grid.low = low;
    grid.step = std::max(1e-3, (high - low) / double(grid.cells));
    return grid;
}

SurfaceTable::SurfaceTable(const Band& band, const Channels& channels,
                           const MaterialLibrary& materials, const std::vector<bool>& used,
                           const TemperatureGrid& grid, std::span<const double> scattered)
    : grid_(grid), padded_(channels.padded()), optics_(materials.size()) {
    const std::size_t nodes = band.node_um.size(), levels = grid.cells + 1;
    const auto level = [&](std::size_t k) { return grid.low + grid.step * double(k); };

    // Per level and node: weight × B, weight × dB/dT × step, weight × shape of B.
    std::vector<double> value(levels * nodes), slope(levels * nodes), shape(levels * nodes);
    for_each_index(
        levels,
        [&](std::size_t k) {
            for (std::size_t n = 0; n < nodes; ++n) {
                const double um = band.node_um[n], w = band.weight[n];
                value[k * nodes + n] = w * planck(um, level(k));
                slope[k * nodes + n] = w * planck_derivative(um, level(k)) * grid_.step;
                const std::size_t c = static_cast<std::size_t>(
                    std::upper_bound(channels.first.begin(), channels.first.end(), n) -
                    channels.first.begin());
                shape[k * nodes + n] =
                    w * planck_shape(um, band.node_um[channels.first[c] - 1], level(k));
            }
        },
        4);

    // Channel sums at a level of something per node.
    const auto sum = [&](const std::vector<double>& of, std::size_t k, std::size_t c,
                         const std::vector<double>& factor) {
        double total = 0.0;
        for (std::size_t n = channels.first[c]; n < channels.first[c + 1]; ++n) {
            total += of[k * nodes + n] * factor[n];
        }
        return total;
    };
    const auto cubics = [&](const std::vector<double>& factor) {
        std::vector<float> table(grid.cells * 4 * padded_, 0.0f);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            double v0 = sum(value, 0, c, factor), s0 = sum(slope, 0, c, factor);
            for (std::size_t k = 0; k < grid.cells; ++k) {
                const double v1 = sum(value, k + 1, c, factor), s1 = sum(slope, k + 1, c, factor);
                const auto power = hermite(v0, s0, v1, s1);
                for (std::size_t p = 0; p < 4; ++p) {
                    table[(k * 4 + p) * padded_ + c] = static_cast<float>(power[p]);
                }
                v0 = v1;
                s0 = s1;
            }
        }
        return table;
    };

    // The light of surroundings: warm as the facet itself, and lit by the sun. At night, where that
    // may be too faint for a number, its shape.
    std::vector<double> around = scattered.empty() ? shape : value;
    for (std::size_t k = 0; k < levels && !scattered.empty(); ++k) {
        for (std::size_t n = 0; n < nodes; ++n) {
            around[k * nodes + n] += band.weight[n] * scattered[n];
        }
    }

    const std::vector<double> one(nodes, 1.0);
    black_ = cubics(one);
    for (std::size_t m = 0; m < materials.size(); ++m) {
        if (m >= used.size() || !used[m]) continue;
        const Material& material = materials[MaterialId{static_cast<std::uint16_t>(m)}];
        Optics& optics = optics_[m];
        std::vector<double> emissivity(nodes), reflectance(nodes), through(nodes, 0.0);
        for (std::size_t n = 0; n < nodes; ++n) {
            reflectance[n] = material.reflectance.at(band.node_um[n]);
            if (!material.transmittance.empty()) {
                through[n] = material.transmittance.at(band.node_um[n]);
            }
            emissivity[n] = 1.0 - reflectance[n] - through[n];
        }
        optics.emitted = cubics(emissivity);
        optics.reflectance.assign(grid.cells * 2 * padded_, 0.0f);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const auto mean = [&](std::size_t k) {
                for (const auto* light : {&around, &shape}) {
                    const double whole = sum(*light, k, c, one);
                    if (whole > 0.0) return sum(*light, k, c, reflectance) / whole;
                }
                return 0.0;
            };
            double v0 = mean(0);
            for (std::size_t k = 0; k < grid.cells; ++k) {
                const double v1 = mean(k + 1);
                optics.reflectance[k * 2 * padded_ + c] = static_cast<float>(v0);
                optics.reflectance[(k * 2 + 1) * padded_ + c] = static_cast<float>(v1 - v0);
                v0 = v1;
            }
        }
        optics.transparent = !material.transmittance.empty();
        if (optics.transparent && std::holds_alternative<Interior>(material.thermal.bottom)) {
            std::vector<double> room(nodes);
            for (std::size_t n = 0; n < nodes; ++n) {
                room[n] = planck(band.node_um[n], temperature_behind(material, 0.0));
            }
            optics.room = channel_sums(band, channels, through, room);
        }
    }
}

void SurfaceTable::black(float temperature, float* out) const {
    float t = 0.0f;
    const std::size_t cell = grid_.cell(temperature, t);
    evaluate_cubic(&black_[cell * 4 * padded_], padded_, t, out);
}

void SurfaceTable::surface(MaterialId material, float temperature, float* emitted,
                           float* reflectance) const {
    const Optics& optics = optics_[static_cast<std::size_t>(material)];
    assert(!optics.emitted.empty());
    float t = 0.0f;
    const std::size_t cell = grid_.cell(temperature, t);
    evaluate_cubic(&optics.emitted[cell * 4 * padded_], padded_, t, emitted);
    const float *r0 = &optics.reflectance[cell * 2 * padded_], *r1 = r0 + padded_;
#pragma omp simd
    for (std::size_t c = 0; c < padded_; ++c) reflectance[c] = r0[c] + t * r1[c];
}

const float* SurfaceTable::room(MaterialId material) const {
    const Optics& optics = optics_[static_cast<std::size_t>(material)];
    return optics.room.empty() ? nullptr : optics.room.data();
}

bool SurfaceTable::transparent(MaterialId material) const {
    return optics_[static_cast<std::size_t>(material)].transparent;
}

TemperatureScale::TemperatureScale(const Band& band, float low, float high) : band_(band) {
    if (!(low > 0.0f && high >= low)) return;
    // 64 cells an octave, or fewer where the radiances span many.
    const auto from = std::bit_cast<std::uint32_t>(low), to = std::bit_cast<std::uint32_t>(high);
    shift_ = 17;
    while ((to >> shift_) - (from >> shift_) > 512) ++shift_;
    first_ = from >> shift_;
    const std::size_t cells = (to >> shift_) - first_ + 1;
    std::vector<double> value(cells + 1), slope(cells + 1), radiance(cells + 1);
    for_each_index(
        cells + 1,
        [&](std::size_t k) {
            radiance[k] = std::bit_cast<float>((first_ + static_cast<std::uint32_t>(k)) << shift_);
            value[k] = brightness_temperature(band_, radiance[k]);
            slope[k] = 1.0 / band_radiance_derivative(band_, value[k]);
        },
        4);
    cubic_.resize(cells);
    for (std::size_t k = 0; k < cells; ++k) {
        const double width = radiance[k + 1] - radiance[k];
        const auto power = hermite(value[k], slope[k] * width, value[k + 1], slope[k + 1] * width);
        std::copy(power.begin(), power.end(), cubic_[k].begin());
    }
}

double TemperatureScale::operator()(double radiance) const {
    if (!(radiance > 0.0)) return 0.0;
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(radiance));
    const std::uint32_t cell = (bits >> shift_) - first_;
    if (cell >= cubic_.size()) return brightness_temperature(band_, radiance);
    const auto at = [&](std::uint32_t k) {
        return double{std::bit_cast<float>((first_ + k) << shift_)};
    };
    const double from = at(cell), t = (radiance - from) / (at(cell + 1) - from);
    const auto& [a, b, c, d] = cubic_[cell];
    return a + t * (b + t * (c + t * d));
}

}  // namespace diurna
