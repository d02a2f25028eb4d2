#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "terrain/ground/rings.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// An area of ground with its own border: a runway, a car park, a field, or an area with a finer
/// mesh.
struct Footprint {
    /// Corners in fractional (column, row) of the raster, post (c, r) at (c, r); in either order,
    /// not closed. `raster_places` computes them from local or geodetic coordinates.
    std::vector<Eigen::Vector2d> ring;
    /// Triangle edges on the ring are at most this long, and about this long inside [m].
    double largest_edge = std::numeric_limits<double>::infinity();
    bool lattice = true;  // inside the ring too, not only on it
    bool owner = true;    // of the triangles inside; else it only refines the mesh
    bool border = true;   // the ring is a line of the mesh
    /// [m/m] Growth of triangle edges with distance from the ring, outside it (grade_round.hpp);
    /// without a lattice `inward` grades the inside instead. Infinite: not graded.
    double growth = std::numeric_limits<double>::infinity();
    bool inward = false;
};

/// The part of its ring on the raster. Throws InputError for a ring of less than three corners,
/// with a corner that is not finite, or entirely outside, and for an edge below 1 cm.
///
/// - number: of the footprint, from 0, for the message
Ring ring_on(const Dem& dem, const Footprint& footprint, std::size_t number);

}  // namespace diurna
