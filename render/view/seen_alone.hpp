#pragma once

#include <cstddef>

#include "render/view/observer.hpp"
#include "render/view/place_in_picture.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Pixels whose centre an object covers, ignoring everything in front of it.
struct SeenAlone {
    double inside = 0.0;   // outside its edges, if it were larger
    double outside = 0.0;  // where the picture would be if it went on beyond its edges
};

/// Counts them within `box`, by a ray through each pixel's centre; outside the picture's edges, for
/// boxes of more than 4 million pixels, by one in each square of them.
///
/// - alone: only the object's facets
SeenAlone seen_alone(const Observer& observer, const RayScene& alone, const PictureBox& box);

}  // namespace diurna
