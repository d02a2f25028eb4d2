#include "terrain/texture/texture.hpp"

#include <cmath>

namespace diurna {

Eigen::Vector2d texture_place(const TextureFrame& frame, const Eigen::Vector3d& place,
                              const Eigen::Vector3f& of_facet) {
    const Eigen::Vector3d from = frame.to_level * (place - frame.origin);
    const Eigen::Vector3f normal = (frame.to_level * of_facet.cast<double>()).cast<float>();
    constexpr float steep = 0.6f;
    if (std::abs(normal.z()) >= steep) {
        const double c = std::cos(frame.heading), s = std::sin(frame.heading);
        return {c * from.x() - s * from.y(), s * from.x() + c * from.y()};
    }
    const Eigen::Vector2d out = normal.head<2>().cast<double>().normalized();
    return {from.y() * out.x() - from.x() * out.y(), from.z()};
}

double texture_at(const Texture& texture, const Eigen::Vector2d& place, double spacing) {
    if (const auto* raster = std::get_if<RasterTexture>(&texture)) {
        return raster->at(place.x(), place.y(), spacing);
    }
    const auto& clutter = std::get<ClutterTexture>(texture);
    return clutter.mean + clutter.deviation * clutter.field.at(place.x(), place.y(), spacing);
}

}  // namespace diurna
