#pragma once

#include <cstddef>

#include "terrain/ground/ground_mesh.hpp"
#include "terrain/ground/tin.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Checks a network by rasterising each triangle, independent of how it was made: over the posts of
/// the raster or, on a detail, over the detail's posts.
struct TinCheck {
    double worst_error = 0.0;         // [m] vertical
    double rms_error = 0.0;           // [m]
    double worst_on_detail = 0.0;     // [m] vertical; on details only
    std::size_t uncovered_posts = 0;  // valid posts under no triangle
    std::size_t flipped_triangles = 0;
};
TinCheck check_tin(const Dem& dem, const Tin& tin);
TinCheck check_ground_mesh(const Dem& dem, const GroundMesh& mesh);

}  // namespace diurna
