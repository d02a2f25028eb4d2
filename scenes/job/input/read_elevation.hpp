#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/job/input/read_details.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// The ground of a scene: its raster, and how it is used.
struct ElevationInput {
    std::filesystem::path file;
    std::vector<std::filesystem::path> tiles;  // further ones, on the same lattice
    DemOptions reading;
    double tolerance = 1.0;            // of its mesh, vertical [m]
    std::vector<DetailInput> details;  // finer rasters on it, later ones on top
    double refraction = 0.0;           // k of lines of sight (Site)
};

/// Its keys in the section [terrain]. `site` is the centre of `radius_m`.
ElevationInput read_elevation_keys(const Section& terrain, const std::optional<Site>& site);

/// The raster and its tiles joined, with the finer rasters of parts of it. Throws InputError as
/// read_dem (terrain/raster/read_dem.hpp) and lay_detail (terrain/ground/dem_detail.hpp).
Dem read_elevation(const ElevationInput& input);

/// Origin of a scene's frame.
struct SceneFrame {
    Site site;
    double sea_level_height = 0.0;  // of its origin above the sea [m]
};

/// At the site that a file names, on the ground if it has no height; without one at the middle of
/// the raster. Throws InputError(where) for a site without a height that is outside the raster or
/// on a void.
SceneFrame frame_of(const std::optional<Site>& site, const ElevationInput& elevation,
                    const Dem& dem, const std::string& where);

}  // namespace diurna
