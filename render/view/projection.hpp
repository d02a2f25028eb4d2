#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace diurna {

/// Projection of directions to positions in the picture; θ is the angle from the optical axis, r
/// the distance from the picture's middle.
enum class Projection {
    pinhole,       // r = f tan θ
    equidistant,   // r = f θ: a fisheye with radius proportional to angle
    equisolid,     // r = 2 f sin(θ/2): a fisheye whose pixels have equal solid angles
    panorama,      // columns are azimuths, rows elevations, in equal steps; the axis' elevation and
                   // roll rotate it as a whole
    orthographic,  // parallel rays from a plane through the position, across the axis
};

/// Words of scene files and of the pictures' attributes.
struct ProjectionWord {
    const char* word;
    Projection projection;
};
inline constexpr std::array projection_words{
    ProjectionWord{"pinhole", Projection::pinhole},
    ProjectionWord{"equidistant", Projection::equidistant},
    ProjectionWord{"equisolid", Projection::equisolid},
    ProjectionWord{"panorama", Projection::panorama},
    ProjectionWord{"orthographic", Projection::orthographic},
};

/// Whether fisheye_radius() and fisheye_angle() apply. A further fisheye is added in this file.
constexpr bool is_fisheye(Projection projection) {
    return projection == Projection::equidistant || projection == Projection::equisolid;
}
/// r / f of a fisheye.
///
/// - angle: θ [rad], 0 to π
inline double fisheye_radius(Projection projection, double angle) {
    return projection == Projection::equidistant ? angle : 2.0 * std::sin(0.5 * angle);
}
/// θ [rad] of a fisheye, the inverse; π beyond the circle's edge.
inline double fisheye_angle(Projection projection, double radius) {
    return projection == Projection::equidistant ? radius
                                                 : 2.0 * std::asin(std::min(1.0, 0.5 * radius));
}

}  // namespace diurna
