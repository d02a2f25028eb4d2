#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/products/export/run_heat.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The ground facets at each post of a raster, seen from above.
struct PostFacets {
    std::vector<std::size_t> begin;    // (post, and one more) into `facet`; posts row by row
    std::vector<std::uint32_t> facet;  // ascending for each post
};

/// For the triangles of objects below `ground_objects`: a post touches a triangle if it is within a
/// hundredth of a posting of it. A post inside a facet has that one, a post at a vertex all facets
/// that meet there, and at a textured place its levels.
PostFacets facets_of_posts(const Dem& dem, const TemperatureMesh& mesh, std::size_t ground_objects);

/// (post) Mean over the facets that each touches [K]; NaN without ground.
std::vector<float> on_posts(const PostFacets& posts, std::span<const float> kelvin);

/// The number of objects of a scene that are ground: the terrain and its polygons, the first ones.
/// Throws InputError if the run's objects have other names, because it is of another scene.
std::size_t ground_objects(const Scene& scene, const RunHeat& heat);

/// Writes the ground's temperatures [K] on the scene's raster, a band for each instant with its UTC
/// as description, as cloud-optimised GeoTIFF in the raster's CRS. Returns the number of posts with
/// a value. Throws InputError if there is none, std::runtime_error if it cannot be written.
std::size_t write_heat_geotiff(const std::filesystem::path& file, const RunHeat& heat,
                               const Scene& scene, std::span<const Instant> instants);

}  // namespace diurna
