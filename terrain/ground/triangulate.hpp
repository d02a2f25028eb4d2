#pragma once

#include <optional>
#include <span>

#include "terrain/ground/tin.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Greedy insertion into a Delaunay triangulation (Garland & Heckbert 1995; CGAL, exact predicates)
/// until no post of the raster is farther than `tolerance` [m] from the surface, measured
/// vertically. Voids are neither inserted nor covered. A tolerance of 0 keeps every post that is
/// not exactly on the surface.
///
/// `slack` (row, column), if given, multiplies the tolerance of each post; more than 0
/// (level_of_detail.hpp). One network without cracks; finer where the slack is small.
Tin triangulate(const Dem& dem, double tolerance, std::span<const float> slack = {});

/// The same; nullopt as soon as the network and its queue exceed this memory.
std::optional<Tin> triangulate_within(const Dem& dem, double tolerance, double most_bytes);

}  // namespace diurna
