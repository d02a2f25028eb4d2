#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "materials/base/parallel.hpp"
#include "terrain/relief/grid_ways.hpp"
#include "terrain/relief/height_field.hpp"

namespace diurna {

/// Which horizon to compute for each post.
struct HorizonRequest {
    double lift = 0.0;                 // [m] of the observer above the post
    float start = 0.0f, stop = 1e30f;  // the tangent is clamped to these
};

/// Tangents of the horizon of one row of tiles (64 rows of posts), whose posts `tangent`
/// holds.
void march_tiles(const HeightField& field, const GridWays& ways, int tile_row,
                 const HorizonRequest& request, std::span<float> tangent);

/// Calls body(row of tiles, its first post, its posts), in parallel.
template <class Body>
void for_each_tile_row(const HeightField& field, const Body& body) {
    const auto row_posts = std::size_t(field.columns()) * tile_side;
    for_each_index(
        static_cast<std::size_t>((field.rows() + tile_side - 1) / tile_side),
        [&](std::size_t row) {
            const std::size_t first = row * row_posts;
            body(static_cast<int>(row), first, std::min(row_posts, field.size() - first));
        },
        1);
}

}  // namespace diurna
