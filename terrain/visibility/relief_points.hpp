#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/relief/height_field.hpp"

namespace diurna {

/// A point of a ground facet, by its cell of the relief.
struct ReliefPoint {
    std::uint32_t post;  // the cell's first, row · columns + column
    float u, v;          // position in the cell, 0 to 1, across and down
};

/// Points of ground facets at which the relief's horizon is evaluated: spread evenly over each
/// facet, one for a facet much smaller than a cell, about six per cell for larger ones, up to
/// 64.
class ReliefPoints {
 public:
    /// The first `ground_facets` are on the relief, within its tolerance. Holds a reference to it.
    ReliefPoints(const FacetSet& facets, const HeightField& relief, std::size_t ground_facets);

    std::size_t facets() const { return coarse_.size(); }
    std::span<const ReliefPoint> of(std::size_t facet) const {
        return std::span(point_).subspan(first_[facet], first_[facet + 1] - first_[facet]);
    }
    /// A facet of more than two cells, which smooths the relief.
    bool coarse(std::size_t facet) const { return coarse_[facet]; }
    /// Some point is outside the relief or next to a void.
    bool off_relief(std::size_t facet) const { return off_relief_[facet]; }

    /// The four posts around a point.
    std::array<std::size_t, 4> posts_round(const ReliefPoint& p) const {
        const std::size_t first = p.post, columns = std::size_t(relief_.columns());
        return {first, first + 1, first + columns, first + columns + 1};
    }
    /// Value (post) at a point, bilinear.
    float at(const ReliefPoint& p, const std::vector<float>& value) const {
        const float* first = value.data() + p.post;
        const float* second = first + relief_.columns();
        const float upper = first[0] + p.u * (first[1] - first[0]);
        const float lower = second[0] + p.u * (second[1] - second[0]);
        return upper + p.v * (lower - upper);
    }
    /// Unit normal of the grid's triangle there.
    Eigen::Vector3f grid_normal(const ReliefPoint& p) const;

 private:
    void add(std::size_t facet, const std::array<Eigen::Vector2d, 3>& corner);

    const HeightField& relief_;
    std::vector<std::uint32_t> first_;  // (ground facet) size + 1
    std::vector<ReliefPoint> point_;
    std::vector<std::uint8_t> coarse_, off_relief_;  // (ground facet)
};

}  // namespace diurna
