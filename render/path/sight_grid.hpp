#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/base/parallel.hpp"
#include "render/light/radiance.hpp"
#include "render/path/interpolation.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Range and height of an observer's targets.
struct PathExtent {
    double observer_height_km = 0.0;  // above the sea, as the heights below
    double least_range_km = 0.0, most_range_km = 0.0;
    double least_height_km = 0.0, most_height_km = 0.0;
};
/// Of a view's targets.
PathExtent path_extent(const View& view, double ground_height_km);

/// Nodes of a table over the lines of sight from one place: uniform in range^⅓ (absorption in
/// saturated lines grows with the root of range, so nodes are denser near the eye) and in height of
/// the far end. Cubic in range; quadratic, or of fourth degree, in height.
struct SightGrid {
    static constexpr std::size_t fewest_ranges = 5;

    explicit SightGrid(const PathExtent& of);

    PathExtent extent;                       // height range not zero
    double root_low = 0.0, root_high = 1.0;  // [km^⅓]
    int segments;  // the same for every line, so that radiance is smooth over the grid
    std::size_t ranges = fewest_ranges, heights = 2;

    /// Node i or j of `count`.
    double root_at(std::size_t i, std::size_t count) const {
        return root_low + (root_high - root_low) * double(i) / double(count - 1);
    }
    double height_at(std::size_t j, std::size_t count) const {
        return extent.least_height_km +
               (extent.most_height_km - extent.least_height_km) * double(j) / double(count - 1);
    }
    /// The line of sight to a range [km, its cube root] and a height.
    SightLine line(double root, double height_km) const {
        return chord(extent.observer_height_km, height_km, root * root * root, segments);
    }

    double places_per_root() const { return double(ranges - 1) / (root_high - root_low); }
    double places_per_height_km() const {
        return double(heights - 1) / (extent.most_height_km - extent.least_height_km);
    }
    /// Position of a range [m] among the ranges.
    double range_place(float range) const {
        const double root = double{std::cbrt(1e-3f * range)};
        return (root - root_low) / (root_high - root_low) * double(ranges - 1);
    }
    /// Position of a height among the heights.
    float height_place(float height_km) const {
        return static_cast<float>((double{height_km} - extent.least_height_km) /
                                  (extent.most_height_km - extent.least_height_km) *
                                  double(heights - 1));
    }
};

/// Uses the fewest heights, of two, three or five, for which enough(count) is true, or five.
template <class Enough>
void choose_heights(SightGrid& grid, const Enough& enough) {
    for (const std::size_t count : {std::size_t{2}, std::size_t{3}, most_few}) {
        grid.heights = count;
        if (enough(count)) return;
    }
}

/// Nodes of the grid, (range, height): its ranges are halved until there are `most` or the error is
/// below a tolerance.
///
/// - make: make(root, height_km) gives a node, from any thread
/// - error: error(nodes, ranges) of the nodes with even ranges alone, from those with odd ones
/// - known: nodes at the nearest, middle and farthest range, of all five heights (range, height),
///   which need not be made again; or empty
template <class Node, class Make, class Error>
std::vector<Node> refine_ranges(SightGrid& grid, std::size_t most, double tolerance,
                                const Make& make, const Error& error, std::span<Node> known = {}) {
    const std::size_t heights = grid.heights;
    const auto add = [&](std::size_t count, std::size_t first, std::size_t every,
                         std::vector<Node>& nodes) {
        const std::size_t made = (count - first + every - 1) / every;
        for_each_index(
            made * heights,
            [&](std::size_t k) {
                const std::size_t i = first + every * (k / heights), j = k % heights;
                nodes[i * heights + j] = make(grid.root_at(i, count), grid.height_at(j, heights));
            },
            1);
    };
    std::vector<Node> nodes(grid.ranges * heights);
    if (known.empty()) {
        add(grid.ranges, 0, 1, nodes);
    } else {
        static_assert(SightGrid::fewest_ranges == 5);
        add(grid.ranges, 1, 2, nodes);
        for (std::size_t k = 0; k < 3 * heights; ++k) {
            const std::size_t i = k / heights, j = k % heights;
            const std::size_t of_five = j * (most_few - 1) / (heights - 1);
            nodes[2 * i * heights + j] = std::move(known[i * most_few + of_five]);
        }
    }
    while (grid.ranges < most) {
        const std::size_t finer = 2 * grid.ranges - 1;
        std::vector<Node> next(finer * heights);
        for (std::size_t i = 0; i < grid.ranges; ++i) {
            for (std::size_t j = 0; j < heights; ++j) {
                next[2 * i * heights + j] = std::move(nodes[i * heights + j]);
            }
        }
        add(finer, 1, 2, next);
        const double worst = error(next, finer);
        nodes = std::move(next);
        grid.ranges = finer;
        if (worst < tolerance) break;
    }
    return nodes;
}

/// Cubic interpolation has an error of fourth order: halving the spacing leaves 1/16 in theory; 1/8
/// is assumed.
inline constexpr double left_by_halving = 1.0 / 8.0;

}  // namespace diurna
