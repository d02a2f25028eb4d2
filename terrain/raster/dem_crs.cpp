#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "materials/base/error.hpp"
#include "terrain/raster/dem_parts.hpp"
#include "terrain/raster/quiet_gdal.hpp"

namespace diurna {

namespace {

/// Our CRS objects take longitude before latitude, easting before northing, whatever EPSG says.
OGRSpatialReference reference_of(const std::string& wkt) {
    OGRSpatialReference reference;
    // A WKT or a name such as EPSG:32611; never a file or an address.
    reference.SetFromUserInput(wkt.c_str(),
                               OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

/// CRS of a raster to WGS84 longitude, latitude and back; made once per CRS and thread.
struct Projection {
    std::string wkt;
    bool geographic = false;
    std::unique_ptr<OGRCoordinateTransformation> to_geodetic, from_geodetic;
};

const Projection& projection_of(const Dem& dem) {
    thread_local Projection last;
    if (last.wkt == dem.crs_wkt && last.to_geodetic) return last;
    OGRSpatialReference reference = reference_of(dem.crs_wkt);
    OGRSpatialReference wgs84;
    wgs84.SetWellKnownGeogCS("WGS84");
    wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    last.to_geodetic.reset(OGRCreateCoordinateTransformation(&reference, &wgs84));
    last.from_geodetic.reset(OGRCreateCoordinateTransformation(&wgs84, &reference));
    last.geographic = reference.IsGeographic();
    if (!last.to_geodetic || !last.from_geodetic) {
        throw InputError(dem.source,
                         "its coordinate reference system cannot be brought to latitude and "
                         "longitude");
    }
    last.wkt = dem.crs_wkt;
    return last;
}

}  // namespace

bool same_reference(const Dem& a, const Dem& b) {
    const OGRSpatialReference first = reference_of(a.crs_wkt), second = reference_of(b.crs_wkt);
    return a.crs_wkt == b.crs_wkt || first.IsSame(&second);
}
bool is_geographic(const Dem& dem) { return projection_of(dem).geographic; }

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
            "{}: its middle, {:.2f} N {:.2f} E, is far from UTM zone {}{}: is the zone right?",
            dem.source, place.latitude_deg, place.longitude_deg, zone, north ? "N" : "S"));
    }
}

void note_datum(Dem& dem) {
    const OGRSpatialReference reference = reference_of(dem.crs_wkt);
    std::unique_ptr<OGRSpatialReference> own(reference.CloneGeogCS());
    if (!own) return;
    own->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const char* name = own->GetAttrValue("DATUM");
    const std::string datum = name ? name : "unknown datum";
    for (const char* near : {"WGS", "World Geodetic", "North_American_Datum_1983",
                             "North American "
                             "Datum 1983",
                             "ETRS", "European Terrestrial", "NZGD2000", "GDA", "SWEREF",
                             "Greek Geodetic Reference System 1987"}) {
        if (datum.find(near) != std::string::npos) return;
    }
    OGRSpatialReference wgs84;
    wgs84.SetWellKnownGeogCS("WGS84");
    wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const QuietGdal gdal;
    const std::unique_ptr<OGRCoordinateTransformation> shift(
        OGRCreateCoordinateTransformation(own.get(), &wgs84));
    const Geodetic centre =
        geodetic_places(dem, std::vector<Eigen::Vector2d>{{0.0, 0.0}}, std::vector<float>{0.0f})
            .front();
    double x = centre.longitude_deg, y = centre.latitude_deg;
    if (!shift || !shift->Transform(1, &x, &y)) return;
    const Site here{centre.latitude_deg, centre.longitude_deg, 0.0};
    const double metres = to_local(here, Geodetic{y, x, 0.0}).head<2>().norm();
    dem.notes.push_back(
        metres < 0.01
            ? fmt::format("{}: no shift from {} to WGS84 is known, its latitudes and longitudes "
                          "are taken as they are: places may be off by 200 m",
                          dem.source, datum)
            : fmt::format("{}: {} is brought to WGS84 by a shift of {:.0f} m, good to a few metres",
                          dem.source, datum, metres));
}
std::vector<double> geoid_heights(std::span<const Geodetic> places) {
    const QuietGdal gdal;
    OGRSpatialReference above_sea = reference_of("EPSG:4326+5773");
    OGRSpatialReference above_ellipsoid = reference_of("EPSG:4979");
    const std::unique_ptr<OGRCoordinateTransformation> shift(
        OGRCreateCoordinateTransformation(&above_sea, &above_ellipsoid));
    if (!shift) throw InputError("EGM96", "PROJ knows no way from it to the ellipsoid");
    std::vector<double> x, y, z(places.size(), 0.0);
    for (const Geodetic& place : places) {
        x.push_back(place.longitude_deg);
        y.push_back(place.latitude_deg);
    }
    std::vector<int> good(places.size(), 1);
    shift->Transform(static_cast<int>(places.size()), x.data(), y.data(), z.data(), good.data());
    // Without the grid PROJ would leave every height as it is.
    if (!places.empty() && (std::find(good.begin(), good.end(), 0) != good.end() ||
                            std::all_of(z.begin(), z.end(), [](double h) { return h == 0.0; }))) {
        throw InputError("EGM96", "PROJ has not got the grid egm96_15 for these places",
                         "apt install proj-data");
    }
    return z;
}

std::vector<Geodetic> geodetic_places(const Dem& dem, std::span<const Eigen::Vector2d> place,
                                      std::span<const float> height) {
    const QuietGdal gdal;
    const auto& t = dem.transform;
    std::vector<double> x(place.size()), y(place.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        const Eigen::Vector2d corner = place[i].array() + 0.5;  // posts are pixel centres
        x[i] = t[0] + t[1] * corner.x() + t[2] * corner.y();
        y[i] = t[3] + t[4] * corner.x() + t[5] * corner.y();
    }
    std::vector<int> good(place.size(), 1);
    projection_of(dem).to_geodetic->Transform(static_cast<int>(place.size()), x.data(), y.data(),
                                              nullptr, good.data());
    std::vector<Geodetic> geodetic(place.size());
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < place.size(); ++i) {
        geodetic[i] = {good[i] ? y[i] : unknown, good[i] ? x[i] : unknown, height[i]};
    }
    return geodetic;
}

std::vector<Eigen::Vector2d> raster_places(const Dem& dem, std::span<const Geodetic> places) {
    const QuietGdal gdal;
    const Projection& projection = projection_of(dem);
    std::vector<double> x(places.size()), y(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        x[i] = places[i].longitude_deg;
        y[i] = places[i].latitude_deg;
    }
    std::vector<int> good(places.size(), 1);
    projection.from_geodetic->Transform(static_cast<int>(places.size()), x.data(), y.data(),
                                        nullptr, good.data());
    const auto& t = dem.transform;
    const double cell = t[1] * t[5] - t[2] * t[4];
    const double middle = t[0] + 0.5 * (t[1] * dem.columns + t[2] * dem.rows);
    std::vector<Eigen::Vector2d> raster(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!good[i]) {
            raster[i].setConstant(std::numeric_limits<double>::quiet_NaN());
            continue;
        }
        // Across the date line the same meridian has two numbers: take the one near the raster.
        if (projection.geographic) x[i] += 360.0 * std::round((middle - x[i]) / 360.0);
        const double dx = x[i] - t[0], dy = y[i] - t[3];
        raster[i] = {(t[5] * dx - t[2] * dy) / cell - 0.5, (t[1] * dy - t[4] * dx) / cell - 0.5};
    }
    return raster;
}

}  // namespace diurna