#include "render/light/band_channels.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "materials/atmosphere/band_model.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/radiance.hpp"

namespace diurna {

namespace {

/// Cubic through values and slopes (per cell) at 0 and 1, by rising power.
std::array<double, 4> hermite(double v0, double s0, double v1, double s1) {
    return {v0, s0, 3.0 * (v1 - v0) - 2.0 * s0 - s1, 2.0 * (v0 - v1) + s0 + s1};
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
