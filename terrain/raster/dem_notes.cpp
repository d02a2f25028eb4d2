#include "terrain/raster/dem_notes.hpp"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "terrain/raster/crs.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/quiet_gdal.hpp"

namespace diurna {

void note_datum(Dem& dem) {
    const OGRSpatialReference reference = reference_of(dem.crs_wkt);
    std::unique_ptr<OGRSpatialReference> own(reference.CloneGeogCS());
    if (!own) return;
    own->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const char* name = own->GetAttrValue("DATUM");
    const std::string datum = name ? name : "unknown datum";
    for (const char* near : {"WGS", "World Geodetic", "North_American_Datum_1983",
                             "North American Datum 1983", "ETRS", "European Terrestrial",
                             "NZGD2000", "GDA", "SWEREF", "Greek Geodetic Reference System 1987"}) {
        if (datum.find(near) != std::string::npos) return;
    }
    const QuietGdal gdal;
    const Transformation shift = transformation(*own, wgs84());
    const Geodetic centre =
        geodetic_places(dem, std::vector<Eigen::Vector2d>{{0.0, 0.0}}, std::vector<float>{0.0f})
            .front();
    double x = centre.longitude_deg, y = centre.latitude_deg;
    if (!shift || !shift->Transform(1, &x, &y)) return;
    const Site here{centre.latitude_deg, centre.longitude_deg, 0.0};
    const double metres = to_local(here, Geodetic{y, x, 0.0}).head<2>().norm();
    dem.notes.push_back(
        metres < 0.01
            ? fmt::format("{}: the shift from {} to WGS84 is unknown; latitudes and longitudes are "
                          "used unchanged, with errors up to 200 m",
                          dem.source, datum)
            : fmt::format(
                  "{}: {} is converted to WGS84 by a shift of {:.0f} m, accurate to a few metres",
                  dem.source, datum, metres));
}

void note_zone(Dem& dem) {
    const OGRSpatialReference reference = reference_of(dem.crs_wkt);
    int north = 0;
    const int zone = reference.GetUTMZone(&north);
    if (zone == 0) return;
    const std::vector<Eigen::Vector2d> middle{{0.5 * dem.columns, 0.5 * dem.rows}};
    const Geodetic place = geodetic_places(dem, middle, std::vector<float>{0.0f}).front();
    const double away = std::abs(std::remainder(place.longitude_deg - (6.0 * zone - 183.0), 360.0));
    // Maps of one zone reach a degree or two into the next; the formulas are good to 7 degrees.
    if (away > 6.0 || (place.latitude_deg < -1.0) == (north != 0)) {
        dem.notes.push_back(fmt::format(
            "{}: its centre, {:.2f} N {:.2f} E, is far from UTM zone {}{}: check the zone",
            dem.source, place.latitude_deg, place.longitude_deg, zone, north ? "N" : "S"));
    }
}

}  // namespace diurna
