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

namespace {

/// Whether a datum agrees with WGS84 within a few metres, so that an unchanged latitude and
/// longitude is right. PROJ has an operation of that accuracy for the realisations of ITRS, fixed
/// to a plate or not (ETRS89 1 m, RGF93 1 m, NAD83 4 m, GDA94 3 m, NZGD2000 1 m, SIRGAS 2000 1 m,
/// JGD2011 2 m: EPSG's accuracies); a ballpark operation, which PROJ uses where it knows none,
/// does not count. CGCS2000 is ITRF97 at epoch 2000.0, and older EPSG tables have no operation.
///
/// place  longitude and latitude [deg], as operations have areas
bool near_wgs84(const OGRSpatialReference& geographic, const std::string& datum,
                const Eigen::Vector2d& place) {
    constexpr double few_metres = 5.0;
    for (const char* known : {"China_2000", "China 2000", "China_Geodetic_Coordinate_System_2000",
                              "China Geodetic Coordinate System 2000"}) {
        if (datum.find(known) != std::string::npos) return true;
    }
    OGRCoordinateTransformationOptions options;
    options.SetBallparkAllowed(false);
    options.SetDesiredAccuracy(few_metres);
    const OGRSpatialReference geodetic = wgs84();
    const Transformation exact(OGRCreateCoordinateTransformation(&geographic, &geodetic, options));
    double x = place.x(), y = place.y();
    return exact && exact->Transform(1, &x, &y);
}

}  // namespace

void note_datum(Dem& dem) {
    constexpr double uncertain = 2.0;  // [m] of WGS84's own realisations
    const OGRSpatialReference reference = reference_of(dem.crs_wkt);
    std::unique_ptr<OGRSpatialReference> own(reference.CloneGeogCS());
    if (!own) return;
    own->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const char* name = own->GetAttrValue("DATUM");
    const std::string datum = name ? name : "unknown datum";
    const auto has = [&](const char* part) { return datum.find(part) != std::string::npos; };
    if ((has("WGS") || has("World Geodetic") || has("World_Geodetic")) && !has("72")) return;
    const QuietGdal gdal;
    const Transformation shift = transformation(*own, wgs84());
    const Geodetic centre =
        geodetic_places(dem, std::vector<Eigen::Vector2d>{{0.0, 0.0}}, std::vector<float>{0.0f})
            .front();
    double x = centre.longitude_deg, y = centre.latitude_deg;
    if (!shift || !shift->Transform(1, &x, &y)) return;
    const Site here{centre.latitude_deg, centre.longitude_deg, 0.0};
    const double metres = to_local(here, Geodetic{y, x, 0.0}).head<2>().norm();
    if (metres >= uncertain) {
        dem.notes.push_back(
            fmt::format("{}: {} is converted to WGS84 by a shift of {:.0f} m, accurate to a few "
                        "metres",
                        dem.source, datum, metres));
    } else if (!near_wgs84(*own, datum, {centre.longitude_deg, centre.latitude_deg})) {
        dem.notes.push_back(
            fmt::format("{}: the shift from {} to WGS84 is unknown; latitudes and longitudes are "
                        "used unchanged, with errors up to 200 m",
                        dem.source, datum));
    }
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
            "{}: its centre, {:.2f} {}, {:.2f} {}, is far from UTM zone {}{}: check the zone",
            dem.source, std::abs(place.latitude_deg), place.latitude_deg < 0.0 ? 'S' : 'N',
            std::abs(place.longitude_deg), place.longitude_deg < 0.0 ? 'W' : 'E', zone,
            north ? "N" : "S"));
    }
}

}  // namespace diurna
