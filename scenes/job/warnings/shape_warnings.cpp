#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/job/warnings/scene_warnings.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/land_shapes.hpp"

namespace diurna {

namespace {

/// A degree of latitude on the way, more than any raster of a scene reaches [m].
constexpr double far_m = 100e3;

double metres_from(const Site& site, double latitude_deg, double longitude_deg) {
    if (!(std::abs(latitude_deg) <= 90.0)) return 1e9;
    return to_local(site, Geodetic{latitude_deg, longitude_deg, site.height}).head<2>().norm();
}

}  // namespace

std::vector<Mistake> shape_warnings(const Prepared& prepared) {
    const Site& site = prepared.world.site;
    std::vector<Mistake> warnings;
    for (const ShapesInput& input : prepared.scene.terrain.shapes) {
        double nearest = 1e9, nearest_turned = 1e9;
        for (const LandShape& shape :
             read_shapes(input.file, "", "", input.confines, input.layer)) {
            const Geodetic& corner = shape.ring.front();
            nearest =
                std::min(nearest, metres_from(site, corner.latitude_deg, corner.longitude_deg));
            nearest_turned = std::min(nearest_turned,
                                      metres_from(site, corner.longitude_deg, corner.latitude_deg));
        }
        if (nearest < far_m) continue;
        const bool turned = nearest_turned < far_m;
        warnings.push_back(
            {input.file.string(),
             turned ? "no shape is near the site, but all would be with latitude and longitude "
                      "exchanged"
                    : fmt::format("no shape is near the site: the nearest is {:.0f} km away",
                                  1e-3 * nearest),
             turned ? "GeoJSON has longitude before latitude: convert with ogr2ogr -s_srs "
                      "EPSG:4326 -t_srs CRS:84 OUT IN, or correct the program that writes the file"
                    : "check the file, site.latitude_deg and site.longitude_deg"});
    }
    return warnings;
}

}  // namespace diurna
