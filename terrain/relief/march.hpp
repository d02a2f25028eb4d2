#pragma once

#include <cstddef>
#include <cstdint>

namespace diurna {

/// Inner loop of `height_field`, one per processor type: 64 posts of a row in parallel. Only
/// plain pointers, so that no inline function compiled for a newer processor leaves these
/// units.

inline constexpr int march_lanes = 64;   // posts of a row that are marched together
inline constexpr int march_steps = 8;    // grid lines per stretch of a path
inline constexpr int tile_columns = 16;  // of the grid of highest posts
inline constexpr int tile_rows = 4;
inline constexpr float no_ground = -1e30f;  // [m] beyond the border, and over voids

/// Crossing of a path from a post with a grid line: between two posts, given by their distance in
/// memory from the first post.
struct Crossing {
    std::int32_t first, second;
    float weight;            // of the second
    float inverse_distance;  // [1/m] in plan
};

/// A stretch of a path: its crossings, and the first column and row reached, relative to the
/// post.
struct Stretch {
    std::int32_t begin, end;  // crossings
    std::int32_t column, row;
    float inverse_near;  // [1/m] 1 / distance to its start
};

/// Heights (row, column) with a border of `no_ground`, and the highest post of each window: a
/// stretch from any of 64 neighbours is in the window of its first column and row.
struct MarchField {
    const float* up;
    std::ptrdiff_t pitch;
    int columns, rows;
    const float* window;
    std::ptrdiff_t window_pitch;
    float highest;
};

struct MarchWay {
    const Crossing* crossing;
    const Stretch* stretch;
    int stretches;
};

/// The posts to be computed, and the range of their horizons.
struct MarchPart {
    int first_row, last_row, first_column, last_column;  // [first, last)
    float lift;                                          // [m] of the observer above the post
    float start, stop;  // tangents: the horizon is at least `start` (zero or more), and exact only
                        // below `stop`
};

/// Tangents of the horizon above the posts of a part (row, column), clamped to [start, stop].
using MarchFunction = void(const MarchField& field, const MarchWay& way, const MarchPart& part,
                           float* tangent, std::ptrdiff_t tangent_pitch);
MarchFunction march_avx2, march_avx512;

}  // namespace diurna
