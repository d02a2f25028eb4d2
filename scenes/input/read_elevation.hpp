#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/input/read_details.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// What a scene's ground is made of: its raster, and how that is to be taken.
struct ElevationInput {
    std::filesystem::path file;
    std::vector<std::filesystem::path> tiles;  // more of it, on the same lattice
    DemOptions reading;
    double tolerance = 1.0;            // of its mesh, vertical [m]
    std::vector<DetailInput> details;  // finer models on it, later ones on top
    double refraction = 0.0;           // k of lines of sight (Site)
};

/// Its keys in the section [terrain]. `site` is the middle of a `radius_m`.
ElevationInput read_elevation_keys(const Section& terrain, const std::optional<Site>& site);

/// The raster and its tiles as one, and on it the finer models of part of it. Throws InputError as
/// read_dem (terrain/raster/read_dem.hpp) and lay_detail (terrain/ground/dem_detail.hpp) do.
Dem read_elevation(const ElevationInput& input);

/// Where the frame of a scene stands.
struct SceneFrame {
    Site site;
    double sea_level_height = 0.0;  // of its origin above the sea [m]
};

/// Of the site that a file names, on the ground where that has no height; without one the middle of
/// the raster. Throws InputError(where) for a site without a height beyond the raster or over a
/// void.
SceneFrame frame_of(const std::optional<Site>& site, const ElevationInput& elevation,
                    const Dem& dem, const std::string& where);

}  // namespace diurna
