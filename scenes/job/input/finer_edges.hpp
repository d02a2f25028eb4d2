#pragma once

#include "scenes/job/input/read_elevation.hpp"
#include "scenes/job/input/read_terrain.hpp"

/// Scene key scene.finer_edges: one number for the size of every facet.
namespace diurna {

/// Divides tolerances of the ground's mesh by the square of `finer`, so that its edges are divided
/// by it: the distance of a chord from an arc grows with the square of its length.
///
/// - finer: above 0
void divide_tolerances(double finer, ElevationInput& elevation);

/// Divides edges of ground polygons, shapes, buildings, objects, and of the ground around objects.
/// A model without largest_edge_m is cut where an edge is longer than the longest twentieth of its
/// own, divided by `finer`.
void divide_edges(double finer, TerrainInput& terrain);

}  // namespace diurna
