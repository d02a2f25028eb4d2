#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"
#include "materials/matter/microfacet.hpp"

namespace diurna {

/// The sun in a rough mirror: D G π / (4 cosθ_eye cosθ_sun), to be multiplied by a microfacet's
/// reflectance at the half angle, by sunlight_on() and by irradiance (microfacet.hpp; for water
/// this is Cox & Munk's glitter). The sun's disc, of 0.2666° radius, widens the lobe: by half of
/// that for the half vector. Zero from behind.
///
/// - normal, eye, to_sun: unit vectors away from the surface
/// - eye_cosine: of the angle to the normal
inline double sun_glint(Microfacets surface, const Eigen::Vector3d& normal,
                        const Eigen::Vector3d& eye, const Eigen::Vector3d& to_sun,
                        double eye_cosine) {
    if (normal.dot(eye) <= 0.0 || normal.dot(to_sun) <= 0.0) return 0.0;
    surface.roughness = std::hypot(surface.roughness, 0.5 * radians(0.2666));
    const Eigen::Vector3d half = (eye + to_sun).normalized();
    const double cosine = std::max(1e-3, eye_cosine), sun_cosine = normal.dot(to_sun);
    return surface.lobe(half.dot(normal), cosine, sun_cosine) * std::numbers::pi;
}

}  // namespace diurna
