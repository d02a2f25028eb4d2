#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "terrain/raster/grid.hpp"

namespace diurna {

/// A picture whose texels are values, placed on a plane.
class RasterTexture {
 public:
    struct Layout {
        int columns = 0, rows = 0;
        std::vector<float> value;  // (row, column), the first row on top; NaN: no value
        bool nearest = false;      // constant over a texel; else linear between the middles
        bool repeat = false;       // repeated in both directions; else no value outside
        /// Place in texels (0, 0 the first one's outer corner) as a polynomial in x and y [m]:
        /// 1, x, y, x², xy, y².
        std::array<Eigen::Vector2d, 6> to_texel{};
    };
    explicit RasterTexture(Layout layout);

    /// Value at a place [m]; NaN without a value. Texels finer than `spacing` [m], the distance to
    /// the next place requested, are averaged in squares of 2, 4, 8 ... texels.
    double at(double x, double y, double spacing = 0.0) const;
    /// Minimum and maximum within a rectangle around the given places, with a margin of a texel;
    /// both NaN without values.
    std::array<double, 2> range(std::span<const Eigen::Vector2d> places) const;
    double texel() const { return texel_; }  // [m] at the middle of the picture

 private:
    Eigen::Vector2d texel_at(double x, double y) const;
    double look_up(const Grid& level, double column, double row) const;

    Layout layout_;
    std::vector<Grid> level_;  // each half as fine as the one before
    double texel_ = 1.0;
};

}  // namespace diurna
