#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "terrain/ground/rings.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// A piece of ground with a border of its own: a runway, a car park, a field, or just a place where
/// the mesh shall be finer.
struct Footprint {
    /// Corners in fractional (column, row) of the raster, post (c, r) at (c, r); either sense of
    /// turning, not closed. `raster_places` makes them from local or geodetic coordinates.
    std::vector<Eigen::Vector2d> ring;
    /// Triangle edges on the ring are at most this long, and about this long inside [m].
    double largest_edge = std::numeric_limits<double>::infinity();
    bool lattice = true;  // inside the ring too, not only on it
    bool owner = true;    // of the triangles inside; else it only makes the mesh finer
};

/// What of its ring lies on the raster. Throws InputError for a ring of less than three corners,
/// with a corner that is not finite, or wholly outside, and for an edge below 1 cm.
///
/// - number: of the footprint, from 0, for the message
Ring ring_on(const Dem& dem, const Footprint& footprint, std::size_t number);

}  // namespace diurna
