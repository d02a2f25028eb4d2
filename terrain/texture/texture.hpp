#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "terrain/texture/clutter.hpp"

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
    struct Level {
        int columns, rows;
        std::vector<float> value;
    };
    Eigen::Vector2d texel_at(double x, double y) const;
    double look_up(const Level& level, double column, double row) const;

    Layout layout_;
    std::vector<Level> level_;  // each half as fine as the one before
    double texel_ = 1.0;
};

/// Statistical: mean + standard deviation · field.
struct ClutterTexture {
    double mean = 0.0, deviation = 1.0;
    Clutter field;
};

using Texture = std::variant<RasterTexture, ClutterTexture>;

/// How a texture's plane lies in the scene: about an origin, turned by a heading clockwise from
/// north. Surfaces flatter than 53° have it as seen from above; on steeper ones x runs to the right
/// as one looks at them and y upward.
struct TextureFrame {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    double heading = 0.0;  // [rad]
};
Eigen::Vector2d texture_place(const TextureFrame& frame, const Eigen::Vector3d& place,
                              const Eigen::Vector3f& normal);

double texture_at(const Texture& texture, const Eigen::Vector2d& place, double spacing = 0.0);

}  // namespace diurna
