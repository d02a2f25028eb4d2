#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/path/path_table.hpp"

namespace diurna {

/// A grid over range^⅓ and height, fine enough for linear interpolation: that of a PathTable,
/// subdivided.
struct EyeGrid {
    std::size_t ranges = 2, heights = 2;
    float root_low = 0.0f, per_root = 0.0f;      // [m^⅓], cells per m^⅓
    float height_low = 0.0f, per_height = 0.0f;  // [m], cells per m
    double error = 0.0;  // of linear cells [K] of apparent temperature, by `surfaces`
};
/// - surfaces: (band)(surface) radiance at the eye, (range, height of the path's grid), of
///   representative surfaces
/// - tolerance: [K]
EyeGrid eye_grid(const SightGrid& path, double ground_height_km, std::span<const BandLight> bands,
                 std::span<const std::vector<Eigen::MatrixXd>> surfaces, double tolerance);

/// Grid positions of a few targets, one array per number for vectorised computation.
struct GridPlaces {
    static constexpr std::size_t most = 64;
    std::array<std::uint32_t, most> start;  // node at the start of the cell
    std::array<float, most> range, height;  // position in the cell, 0 to 1
    std::array<float, most> per_metre;      // cells per metre of range
};
/// range [m], its cube root, and height [m] of up to `most` targets
void find_places(const EyeGrid& grid, std::span<const float> range,
                 std::span<const float> range_root, std::span<const float> height, GridPlaces& out);

}  // namespace diurna
