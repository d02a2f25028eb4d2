#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "render/light/band_light.hpp"

namespace diurna {

/// The channels of several bands side by side, so that a table position is computed once for all of
/// them: those of band b are lanes [first[b], first[b + 1]), padding included.
struct ChannelLanes {
    std::vector<std::size_t> first{0};  // (band + 1)

    ChannelLanes() = default;
    explicit ChannelLanes(std::span<const BandLight> bands) {
        for (const BandLight& band : bands) {
            first.push_back(first.back() + band.channels.padded());
        }
    }
    std::size_t size() const { return first.back(); }

    /// Rows of channels, row(band), side by side.
    template <class Row>
    std::vector<float> side_by_side(const Row& row) const {
        std::vector<float> all(size(), 0.0f);
        for (std::size_t b = 0; b + 1 < first.size(); ++b) {
            const std::vector<float> one = row(b);
            std::copy(one.begin(), one.end(), all.begin() + std::ptrdiff_t(first[b]));
        }
        return all;
    }
};

}  // namespace diurna
