#include "scenes/job/input/read_elevation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "materials/base/error.hpp"
#include "terrain/ground/dem_detail.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geoid.hpp"
#include "terrain/raster/read_dem.hpp"

namespace diurna {

namespace {

/// How the raster is to be taken.
DemOptions read_dem_options(const Section& section, const std::optional<Site>& site) {
    DemOptions options = read_posts(section, false);
    if (!section.has("radius_m")) return options;
    options.radius = section.number(
        "radius_m",
        "half the side of the square of ground around the site that is used, extended to the next "
        "posts of the raster; default: the whole raster",
        {10.0, 2e5});
    if (site) {
        options.centre = Geodetic{site->latitude_deg, site->longitude_deg, 0.0};
    } else {
        section.mistake("radius_m", "needs a [site], the centre of the radius");
    }
    return options;
}

}  // namespace

ElevationInput read_elevation_keys(const Section& section, const std::optional<Site>& site) {
    ElevationInput elevation;
    elevation.file = section.file(
        "elevation",
        "elevation raster that GDAL reads: GeoTIFF, DTED, SRTM, USGS DEM, ENVI, netCDF, ...");
    const std::vector<std::string> tiles =
        section.texts_or("more_tiles", "adjacent rasters of the same grid", {});
    for (const std::string& tile : tiles) {
        elevation.tiles.push_back(section.file_named("more_tiles", tile));
    }
    elevation.reading = read_dem_options(section, site);
    elevation.tolerance = section.number_or(
        "tolerance_m", "largest vertical distance between mesh and posts", 1.0, {0.0, 1000.0});
    elevation.details = read_details(section, elevation.tolerance, elevation.reading.geoid);
    elevation.refraction = section.number_or("refraction",
                                             "refraction coefficient k of lines of sight: their "
                                             "curvature divided by the earth's; 0.13 by day",
                                             0.0, {0.0, 0.5});
    return elevation;
}

Dem read_elevation(const ElevationInput& input) {
    std::vector<std::filesystem::path> tiles{input.file};
    tiles.insert(tiles.end(), input.tiles.begin(), input.tiles.end());
    Dem dem = read_dem(tiles, input.reading);
    for (const DetailInput& detail : input.details) {
        lay_detail(dem, read_dem(detail.files, detail.reading),
                   {.tolerance = detail.tolerance, .blend = detail.blend});
    }
    return dem;
}

SceneFrame frame_of(const std::optional<Site>& site, const ElevationInput& elevation,
                    const Dem& dem, const std::string& where) {
    SceneFrame frame;
    if (site) {
        frame.site = *site;
        if (std::isnan(site->height)) {
            frame.site.height = height_at(dem, site->latitude_deg, site->longitude_deg);
        } else if (elevation.reading.geoid) {  // as the raster's
            const Geodetic here{site->latitude_deg, site->longitude_deg, 0.0};
            frame.site.height += geoid_heights({&here, 1}).front();
        }
        if (std::isnan(frame.site.height)) {
            throw InputError(where,
                             fmt::format("{:.5f}, {:.5f} is outside {} or over a void",
                                         site->latitude_deg, site->longitude_deg, dem.source));
        }
    } else {
        const Geodetic centre = dem_centre(dem);
        frame.site = {centre.latitude_deg, centre.longitude_deg, centre.height};
    }
    frame.site.refraction = elevation.refraction;
    frame.sea_level_height = frame.site.height;
    if (elevation.reading.geoid) {
        const Geodetic here{frame.site.latitude_deg, frame.site.longitude_deg, 0.0};
        frame.sea_level_height -= geoid_heights({&here, 1}).front();
    }
    return frame;
}

}  // namespace diurna
