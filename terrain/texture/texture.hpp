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

/// How a texture's plane lies in the scene: about an origin, turned by a heading clockwise from
/// north. Surfaces flatter than 53° have it as seen from above; on steeper ones x runs to the right
/// as one looks at them and y upward: all this of an object as it stands when it is level.
struct TextureFrame {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    double heading = 0.0;                                    // [rad]
    Eigen::Matrix3d to_level = Eigen::Matrix3d::Identity();  // takes off its pitch and roll
};
Eigen::Vector2d texture_place(const TextureFrame& frame, const Eigen::Vector3d& place,
                              const Eigen::Vector3f& normal);

/// Value at a place of the texture's plane [m]; NaN where a picture has none. Detail finer than
/// `spacing` [m], that to the next place asked for, is averaged away.
double texture_at(const Texture& texture, const Eigen::Vector2d& place, double spacing = 0.0);

}  // namespace diurna
