#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "terrain/raster/grid.hpp"

namespace diurna {

/// A picture whose texels say a value, laid on a plane.
class RasterTexture {
 public:
    struct Layout {
        int columns = 0, rows = 0;
        std::vector<float> value;  // (row, column), the first row on top; NaN: none
        bool nearest = false;      // a texel's value all over it; else linear between their middles
        bool repeat = false;       // again and again in both directions; else none outside
        /// Place in texels (0, 0 the first one's outer corner) as a polynomial in x and y [m]:
        /// 1, x, y, x², xy, y².
        std::array<Eigen::Vector2d, 6> to_texel{};
    };
    explicit RasterTexture(Layout layout);

    /// Value at a place [m]; NaN where there is none. Texels finer than `spacing` [m], that to the
    /// next place asked for, are averaged in squares of 2, 4, 8 ... texels.
    double at(double x, double y, double spacing = 0.0) const;
    /// Least and greatest within a rectangle about the given places, with a texel around; both NaN
    /// where there is nothing else.
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
