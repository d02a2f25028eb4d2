#pragma once

#include <ogr_spatialref.h>

#include <memory>
#include <string>
#include <vector>

/// Coordinate reference systems by PROJ, through GDAL. Ours take longitude before latitude, easting
/// before northing, whatever EPSG says.
namespace diurna {

/// Of a WKT or a name such as EPSG:32611; never of a file or an address.
OGRSpatialReference reference_of(const std::string& wkt);
OGRSpatialReference wgs84();
std::string wkt_of(const OGRSpatialReference& reference);

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;
/// None where PROJ knows no way.
Transformation transformation(const OGRSpatialReference& from, const OGRSpatialReference& to);

/// Replaces x and y; returns for each place whether it could be brought over.
std::vector<int> transform(OGRCoordinateTransformation& shift, std::vector<double>& x,
                           std::vector<double>& y);

/// A CRS to longitude and latitude of WGS84 [°] and back.
struct GeoProjection {
    std::string wkt;
    bool geographic = false;
    Transformation to_geodetic, from_geodetic;
};
/// Made once per CRS and thread; valid until the thread asks for another. Throws InputError(source)
/// where PROJ knows no way.
const GeoProjection& projection_of(const std::string& wkt, const std::string& source);

bool same_reference(const std::string& wkt, const std::string& other);

}  // namespace diurna
