#pragma once

#include <vector>

#include "render/light/scene_light.hpp"
#include "render/rays/channel_lanes.hpp"

namespace diurna {

/// What arrives at a facet and leaves it, each a row of lanes: black body at its temperature, light
/// of sky and of surroundings that arrives, radiosity as a diffuse surface and the terms it is the
/// sum of.
enum class FacetPart {
    black,
    arriving_sky,
    arriving_surroundings,
    radiosity,
    emitted,
    sun,
    sky,
    surroundings,
    behind
};
inline constexpr std::size_t facet_parts = 9;

/// The parts of the facets that rays meet, in the channels of all bands side by side.
class FacetLanes {
 public:
    /// Of the facets handed to lit_facets().
    FacetLanes(const SceneLight& light, const ChannelLanes& lanes);

    /// - target: which of these
    const float* part(std::uint32_t target, FacetPart p) const {
        return &parts_[(target * facet_parts + static_cast<std::size_t>(p)) * lanes_];
    }

 private:
    std::size_t lanes_;
    std::vector<float> parts_;  // (target, part, lane)
};

}  // namespace diurna
