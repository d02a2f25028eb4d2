#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/lanes.hpp"

namespace diurna {

/// Groups of a band's nodes in one bin of the atmosphere, with a common transmittance. Light
/// leaving a surface is only needed per channel; rows of channels are padded with zeros to whole
/// registers.
struct Channels {
    std::vector<std::uint32_t> first;  // (channel + 1) nodes of channel c: [first[c], first[c + 1])

    std::size_t size() const { return first.size() - 1; }
    std::size_t padded() const { return rounded_up(size()); }
};
Channels channels_of(const Band& band);

/// One wavelength in each channel [µm].
std::vector<double> channel_um(const Band& band, const Channels& channels);

/// Σ weight · spectrum over the nodes of each channel, padded.
std::vector<float> channel_sums(const Band& band, const Channels& channels,
                                std::span<const double> spectrum);

}  // namespace diurna
