#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "terrain/place/site.hpp"

namespace diurna {

/// Whether PROJ knows a coordinate reference system by this name and a way from it to WGS84:
/// "EPSG:32616", "EPSG:31468", a WKT; never a file or an address.
bool is_crs(const std::string& name);

/// Places given in a CRS on the WGS84 ellipsoid, height 0: of a geographic one [latitude,
/// longitude] in degrees, of a projected one [easting, northing] in its unit, whatever order EPSG
/// has. "" is WGS84 itself. Places that it does not reach are NaN. Throws InputError(name) for one
/// that is_crs() does not know.
std::vector<Geodetic> geodetic_of(const std::string& crs, std::span<const Eigen::Vector2d> places);

}  // namespace diurna
