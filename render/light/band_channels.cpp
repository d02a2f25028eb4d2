#include "render/light/band_channels.hpp"

#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/bins.hpp"

namespace diurna {

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

std::vector<double> channel_um(const Band& band, const Channels& channels) {
    std::vector<double> um;
    for (std::size_t c = 0; c < channels.size(); ++c) um.push_back(band.node_um[channels.first[c]]);
    return um;
}

std::vector<float> channel_sums(const Band& band, const Channels& channels,
                                std::span<const double> spectrum) {
    std::vector<float> sums(channels.padded(), 0.0f);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        double sum = 0.0;
        for (std::size_t n = channels.first[c]; n < channels.first[c + 1]; ++n) {
            sum += band.weight[n] * spectrum[n];
        }
        sums[c] = static_cast<float>(sum);
    }
    return sums;
}

}  // namespace diurna
