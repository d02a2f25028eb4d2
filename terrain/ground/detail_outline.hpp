#pragma once

#include <Eigen/Core>

#include "terrain/ground/rings.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Points of a detail's outline such that straight lines between them are within its tolerance of
/// the heights there (Douglas & Peucker 1973), its corners, and every 64th point, since a straight
/// side of one map is curved on another.
Ring outline_vertices(const Dem& dem, const DemDetail& detail);

/// Whether a place is within a twentieth of a detail's posting of its outline, where a vertex would
/// make slivers.
bool beside_outline(const Dem& dem, const Eigen::Vector2d& place);

}  // namespace diurna
