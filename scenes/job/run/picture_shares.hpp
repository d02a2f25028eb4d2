#pragma once

#include <vector>

#include "scenes/job/run/stages.hpp"

namespace diurna {

/// The largest share of any picture filled by a facet of World::surfaces(), directly, in mirrors or
/// through panes: (facet) 0 to 1. For moving observers, and in each stage of moving objects,
/// `most_poses` are evaluated, evenly over their frames.
std::vector<float> picture_shares(const Stages& stages, int most_poses = 24);

/// (facet) 1 if visible in a picture, or a neighbour with a common corner of a visible one, or
/// another level of a texture at their places.
std::vector<std::uint8_t> seen_or_beside(const World& world, const std::vector<float>& share);

}  // namespace diurna
