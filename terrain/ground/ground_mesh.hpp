#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "terrain/ground/tin.hpp"
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

/// The ground as triangles that follow the relief to a tolerance and footprints exactly.
struct GroundMesh {
    std::vector<Eigen::Vector2d> place;                  // (vertex) column, row; not only posts
    std::vector<float> height;                           // (vertex) [m]
    std::vector<std::array<std::uint32_t, 3>> triangle;  // counterclockwise seen from above
    std::vector<std::int32_t> footprint;                 // (triangle) index, −1 outside all
};

/// The greedy network of `triangulate`, cut along the rings of the footprints (CGAL's constrained
/// Delaunay triangulation). Vertices that are not posts have the raster's bilinear height. Where
/// footprints overlap, the later one has the triangle. After cutting, posts are put back until
/// none is further than `tolerance` from the mesh, so the guarantee is that of `triangulate`.
///
/// `slack` (row, column), if given, multiplies the tolerance of each post (level_of_detail).
///
/// A ring is cut off at the raster's edge and left out where it crosses voids. Throws InputError
/// for a ring of less than three corners, with a corner that is not finite, or wholly outside.
///
/// From a scene file to facets:
///
///     const Dem dem = read_dem(file);
///     const Site site = ...;
///     for (polygon in scene) footprints.push_back({raster_places(dem, site, polygon), 25.0});
///     const GroundMesh mesh = ground_mesh(dem, tolerance, footprints);
///     const auto vertex = local_vertices(dem, site, mesh.place, mesh.height);
///     material[t] = mesh.footprint[t] >= 0 ? polygon material : by slope and height;
///     append_facets(facets, vertex, mesh.triangle, material, ObjectId{0});
GroundMesh ground_mesh(const Dem& dem, double tolerance, std::span<const Footprint> footprints = {},
                       std::span<const float> slack = {});

/// The same from a network that is there already, such as `full_grid`.
GroundMesh ground_mesh(const Dem& dem, const Tin& network, double tolerance,
                       std::span<const Footprint> footprints = {},
                       std::span<const float> slack = {});

}  // namespace diurna
