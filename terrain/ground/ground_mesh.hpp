#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/ground/footprint.hpp"
#include "terrain/ground/tin.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The ground as triangles that follow the relief to a tolerance and footprints exactly.
struct GroundMesh {
    std::vector<Eigen::Vector2d> place;                  // (vertex) column, row; not only posts
    std::vector<float> height;                           // (vertex) [m]
    std::vector<std::array<std::uint32_t, 3>> triangle;  // counterclockwise seen from above
    std::vector<std::int32_t> footprint;                 // (triangle) index, −1 outside all
    /// (triangle) index of the raster's detail below it, −1: none; empty without details.
    std::vector<std::int32_t> detail{};
};

/// The greedy network of `triangulate`, cut along the rings of the footprints (CGAL's constrained
/// Delaunay triangulation). Vertices that are not posts have the raster's bilinear height. Where
/// footprints overlap, the later one owns the triangle. After cutting, posts are inserted until
/// none is farther than `tolerance` from the mesh, so the guarantee is that of `triangulate`.
///
/// `slack` (row, column), if given, multiplies the tolerance of each post (level_of_detail).
///
/// On a detail of the raster (dem_detail.hpp) the vertices are posts of the detail's greedy
/// network, and no post of it is farther than its own tolerance from the mesh, regardless of slack;
/// its border is a line of the mesh, so there is neither step nor crack. Only posts within a
/// twentieth of their spacing of the raster's edge or another detail's border are skipped.
///
/// A ring is cut off at the raster's edge and skipped where it crosses voids. Throws InputError for
/// a ring of less than three corners, with a corner that is not finite, or entirely outside.
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

/// The same from existing networks, such as `full_grid`.
///
/// - on_detail: (detail) network over its raster's posts; empty: those of `triangulate`
GroundMesh ground_mesh(const Dem& dem, const Tin& network, double tolerance,
                       std::span<const Footprint> footprints = {},
                       std::span<const float> slack = {}, std::span<const Tin> on_detail = {});

}  // namespace diurna
