#pragma once

#include <span>
#include <vector>

#include "render/view/observer.hpp"
#include "scenes/job/run/stages.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

/// The largest share of any picture filled by a facet of World::surfaces(), directly, in mirrors or
/// through panes, or as one of those whose mean is the ground beyond the raster
/// (scenes/job/run/ground_to_horizon.hpp): (facet) 0 to 1. For moving observers, and in each stage
/// of moving objects, `most_poses` are evaluated, evenly over their frames.
std::vector<float> picture_shares(const Stages& stages, int most_poses = 24);

/// A picture beside those of the scene's observers, as studies make them.
struct SeenView {
    Observer eye;
    Instant when;
    int samples = 1;  // rays of a pixel
};

/// The same for these pictures.
std::vector<float> view_shares(const Stages& stages, std::span<const SeenView> views);

/// (facet) 1 if visible in a picture, or a neighbour with a common corner of a visible one, or
/// another level of a texture at their places.
std::vector<std::uint8_t> seen_or_beside(const World& world, const std::vector<float>& share);

}  // namespace diurna
