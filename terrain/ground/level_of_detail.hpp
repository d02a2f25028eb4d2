#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "terrain/raster/dem.hpp"

namespace diurna {

/// An observer of the ground, or an object on it that is observed.
struct Viewpoint {
    Eigen::Vector2d place;  // (column, row)
    double height = 0.0;    // above the ground there [m]
    double angle = 1e-3;    // of one pixel [rad]
};

/// Slack (row, column) for `ground_mesh`: at each post the size of a pixel of the nearest
/// viewpoint, angle × distance, over `tolerance`; at least 1 and at most `coarsest` / `tolerance`.
/// So the mesh is within a pixel for the viewpoints, and far relief is fine enough for its shadows.
/// shadows.
std::vector<float> level_of_detail(const Dem& dem, std::span<const Viewpoint> viewpoints,
                                   double tolerance, double coarsest);

}  // namespace diurna
