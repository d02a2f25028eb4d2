#pragma once

#include <vector>

#include "scenes/run/stages.hpp"

namespace diurna {

/// The largest share of any picture that a facet of World::surfaces() fills, seen straight, in
/// mirrors or through panes: (facet) 0 to 1. Of observers that go, and in each stage of objects
/// that do, `most_poses` are asked, evenly along their frames.
std::vector<float> picture_shares(const Stages& stages, int most_poses = 24);

/// (facet) 1 where a picture sees it or a neighbour that shares a corner, or another level of a
/// texture in their places.
std::vector<std::uint8_t> seen_or_beside(const World& world, const std::vector<float>& share);

}  // namespace diurna
