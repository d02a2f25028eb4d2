#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/export/run_heat.hpp"
#include "scenes/input/scene.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Which facets of the ground each post of a raster lies on, seen from above.
struct PostFacets {
    std::vector<std::size_t> begin;    // (post, and one more) into `facet`; posts row by row
    std::vector<std::uint32_t> facet;  // ascending for each post
};

/// Of the triangles with objects below `ground_objects`: every post within a hundredth of a posting
/// of a triangle touches it. A post in a facet's inside has that one, a post that is a vertex all
/// that meet there, and of a textured place its levels.
PostFacets facets_of_posts(const Dem& dem, const TemperatureMesh& mesh, std::size_t ground_objects);

/// (post) Mean of the facets that each touches [K]; NaN where there is no ground.
std::vector<float> on_posts(const PostFacets& posts, std::span<const float> kelvin);

/// How many objects of a scene are ground: itself and its polygons, the first ones. Throws
/// InputError where those of the run have other names: where it is of another scene.
std::size_t ground_objects(const Scene& scene, const RunHeat& heat);

/// Writes the ground's temperatures [K] on the scene's raster, a band for each instant with its UTC
/// as description, as cloud-optimised GeoTIFF in the raster's CRS. Returns how many posts have any.
/// Throws InputError where no post has, std::runtime_error where it cannot be written.
std::size_t write_heat_geotiff(const std::filesystem::path& file, const RunHeat& heat,
                               const Scene& scene, std::span<const Instant> instants);

}  // namespace diurna
