#pragma once

#include <Eigen/Core>
#include <variant>

#include "terrain/texture/clutter.hpp"
#include "terrain/texture/raster_texture.hpp"

namespace diurna {

/// Statistical: mean + standard deviation · field.
struct ClutterTexture {
    double mean = 0.0, deviation = 1.0;
    Clutter field;
};

using Texture = std::variant<RasterTexture, ClutterTexture>;

/// Position of a texture's plane in the scene: about an origin, rotated by a heading clockwise from
/// north. Surfaces flatter than 53° show it as seen from above; on steeper ones x is to the right
/// of a viewer who faces them, and y up. For objects this holds in their level position.
struct TextureFrame {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    double heading = 0.0;                                    // [rad]
    Eigen::Matrix3d to_level = Eigen::Matrix3d::Identity();  // removes its pitch and roll
};
Eigen::Vector2d texture_place(const TextureFrame& frame, const Eigen::Vector3d& place,
                              const Eigen::Vector3f& normal);

/// Value at a place of the texture's plane [m]; NaN where a picture has none. Detail finer than
/// `spacing` [m], the distance to the next place requested, is averaged.
double texture_at(const Texture& texture, const Eigen::Vector2d& place, double spacing = 0.0);

}  // namespace diurna
