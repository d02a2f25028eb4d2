#include "terrain/visibility/sky_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diurna {

namespace {

constexpr int cells_near = 3;  // round a patch, where slopes count and not heights
// Ray origins are lifted off their facets and rounded.
constexpr float more = 1.001f, more_yet = 1e-3f;

/// The box of the requested facets.
struct Patch {
    Eigen::Vector3f low, high;

    Patch(const FacetSet& facets, std::size_t begin, std::size_t end)
        : low(facets.centroid[begin]), high(low) {
        for (std::size_t f = begin; f < end; ++f) {
            for (const std::uint32_t v : facets.corner[f]) {
                low = low.cwiseMin(facets.vertex[v]);
                high = high.cwiseMax(facets.vertex[v]);
            }
        }
    }
};

/// Squares of tangents by octant, raised by whatever stands in cells round a patch.
class Skyline {
 public:
    Skyline(const ReliefCells& cells, const Patch& patch)
        : cells_(cells),
          patch_(patch),
          middle_(0.5f * (patch.low + patch.high).head<2>()),
          radius_(0.5f * (patch.high - patch.low).head<2>().norm()) {}

    /// By the steepest slopes of the cells near the patch. False where there is no relief.
    bool raise_by_slopes(const CellBox& near) {
        const int columns = cells_.top.front().columns;
        for (int row = near.first_row; row <= near.last_row; ++row) {
            for (int column = near.first_column; column <= near.last_column; ++column) {
                const ByOctant& here = cells_.steepest[std::size_t(row) * columns + column];
                for (std::size_t o = 0; o < 8; ++o) squared[o] = std::max(squared[o], here[o]);
            }
        }
        if (std::isinf(squared[0])) return false;
        for (float& s : squared) s *= s;
        return true;
    }

    /// By the tops of one level's cells, in the cells `next` of the level above and outside `near`.
    void raise_by_tops(std::size_t level, float side, const CellBox& near, const CellBox& next) {
        const Grid& top = cells_.top[level];
        const int last_row = std::min(2 * next.last_row + 1, top.rows - 1);
        const int last_column = std::min(2 * next.last_column + 1, top.columns - 1);
        for (int row = 2 * next.first_row; row <= last_row; ++row) {
            const float lowest = least();
            const float south = cells_.corner.y() + side * float(row);
            const float dy =
                std::max({south - patch_.high.y(), patch_.low.y() - south - side, 0.0f});
            const bool beside = row >= near.first_row && row <= near.last_row;
            for (int column = 2 * next.first_column; column <= last_column; ++column) {
                if (beside && column == near.first_column) column = near.last_column + 1;
                if (column > last_column) break;
                const float rise = top.at(row, column) - patch_.low.z();
                const float west = cells_.corner.x() + side * float(column);
                const float dx =
                    std::max({west - patch_.high.x(), patch_.low.x() - west - side, 0.0f});
                const float away = dx * dx + dy * dy;
                if (!(rise > 0.0f && rise * rise > lowest * away)) continue;
                raise_towards({west, south}, side, rise * rise / away);
            }
        }
    }

    float least() const { return *std::min_element(squared.begin(), squared.end()); }

    ByOctant squared{};

 private:
    /// The octants that a circle round a cell reaches into, seen from anywhere in one round the
    /// patch.
    void raise_towards(const Eigen::Vector2f& south_west, float side, float steep) {
        const float reach = radius_ + 0.70710678f * side;
        const Eigen::Vector2f way = south_west.array() + 0.5f * side;
        const Eigen::Vector2f to = way - middle_;
        const float free = to.squaredNorm() - reach * reach;
        const float limit = free > 0.0f
                                ? cos_half_octant * std::sqrt(free) - sin_half_octant * reach
                                : -std::numeric_limits<float>::infinity();
        for (std::size_t o = 0; o < 8; ++o) {
            const float along = to.x() * octant_middles.east[o] + to.y() * octant_middles.north[o];
            squared[o] = along >= limit ? std::max(squared[o], steep) : squared[o];
        }
    }

    const ReliefCells& cells_;
    const Patch& patch_;
    Eigen::Vector2f middle_;
    float radius_;
};

}  // namespace

SkyBound::Sines SkyBound::sines(const FacetSet& facets, std::size_t begin, std::size_t end) const {
    if (!cells_.known() || begin == end) return unknown;
    const Patch patch(facets, begin, end);
    CellBox near = cells_.cells_of(patch.low.head<2>(), patch.high.head<2>());
    near = {std::max(near.first_column - cells_near, 0),
            std::min(near.last_column + cells_near, cells_.top.front().columns - 1),
            std::max(near.first_row - cells_near, 0),
            std::min(near.last_row + cells_near, cells_.top.front().rows - 1)};
    Skyline skyline(cells_, patch);
    if (!skyline.raise_by_slopes(near)) return unknown;

    // Rings of cells outward, each ring of cells twice as wide as those of the one before.
    const float highest = cells_.top.back().value.front() - patch.low.z();
    float side = cells_.side;
    for (std::size_t k = 0; k < cells_.top.size(); ++k, side *= 2.0f) {
        const CellBox next{std::max((near.first_column >> 1) - 1, 0), (near.last_column >> 1) + 1,
                           std::max((near.first_row >> 1) - 1, 0), (near.last_row >> 1) + 1};
        skyline.raise_by_tops(k, side, near, next);
        // Whatever lies outside the next ring is farther than one of its cells.
        const float beyond = 2.0f * side;
        if (!(highest > 0.0f) || highest * highest <= skyline.least() * beyond * beyond) break;
        near = {next.first_column, std::min(next.last_column, (cells_.top[k].columns - 1) / 2),
                next.first_row, std::min(next.last_row, (cells_.top[k].rows - 1) / 2)};
    }
    Sines sines;
    for (std::size_t o = 0; o < 8; ++o) {
        const float tangent = std::sqrt(skyline.squared[o]) * more + more_yet;
        sines[o] = tangent / std::sqrt(1.0f + tangent * tangent);
    }
    return sines;
}

}  // namespace diurna
