#pragma once

#include <ogr_spatialref.h>

#include <memory>
#include <string>
#include <vector>

/// Coordinate reference systems by PROJ, through GDAL. Here longitude comes before latitude and
/// easting before northing, regardless of EPSG's axis order.
namespace diurna {

/// From a WKT or a name such as EPSG:32611; never from a file or an address.
OGRSpatialReference reference_of(const std::string& wkt);
OGRSpatialReference wgs84();
std::string wkt_of(const OGRSpatialReference& reference);

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;
/// Null if PROJ has no transformation.
Transformation transformation(const OGRSpatialReference& from, const OGRSpatialReference& to);

/// Replaces x and y; returns for each place whether it could be transformed.
std::vector<int> transform(OGRCoordinateTransformation& shift, std::vector<double>& x,
                           std::vector<double>& y);

/// A CRS to longitude and latitude of WGS84 [°] and back.
struct GeoProjection {
    std::string wkt;
    bool geographic = false;
    Transformation to_geodetic, from_geodetic;
};
/// Created once per CRS and thread; valid until the thread requests another. Throws
/// InputError(source) if PROJ has no transformation.
const GeoProjection& projection_of(const std::string& wkt, const std::string& source);

bool same_reference(const std::string& wkt, const std::string& other);

}  // namespace diurna
