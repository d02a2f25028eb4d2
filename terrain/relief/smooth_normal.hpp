#pragma once

#include <Eigen/Core>

#include "terrain/relief/height_field.hpp"

namespace diurna {

/// Unit normal of the relief at a place between posts: those of the four posts around it
/// (HeightField::normal), bilinear. Continuous over the whole raster, so that it is the normal of
/// the surface that the posts describe, not of one triangle between them. Outside the raster: of
/// the nearest posts. Exact for a plane; for a paraboloid on a grid of spacing h within O(h²).
///
/// - place: east, north [m] in the frame of the scene
Eigen::Vector3f smooth_normal(const HeightField& relief, const Eigen::Vector2d& place);

}  // namespace diurna
