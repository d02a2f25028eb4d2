#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "terrain/raster/dem.hpp"

namespace diurna {

/// Someone who looks at the ground, or something on it that is looked at.
struct Viewpoint {
    Eigen::Vector2d place;  // (column, row)
    double height = 0.0;    // above the ground there [m]
    double angle = 1e-3;    // that one pixel sees [rad]
};

/// Slack (row, column) for `ground_mesh`: at each post what a pixel of the nearest viewpoint sees,
/// angle × distance, over `tolerance`; at least 1 and at most `coarsest` / `tolerance`. So the mesh
/// errs by a pixel at most where someone looks, and far relief keeps what its shadows need.
std::vector<float> level_of_detail(const Dem& dem, std::span<const Viewpoint> viewpoints,
                                   double tolerance, double coarsest);

}  // namespace diurna
