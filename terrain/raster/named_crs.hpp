#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "terrain/place/site.hpp"

namespace diurna {

/// Whether PROJ knows a coordinate reference system by this name and can transform it to WGS84:
/// "EPSG:32616", "EPSG:31468", a WKT; never a file or an address.
bool is_crs(const std::string& name);

/// Converts places in a CRS to the WGS84 ellipsoid, height 0: for a geographic CRS [latitude,
/// longitude] in degrees, for a projected one [easting, northing] in its unit, regardless of EPSG's
/// axis order. "" is WGS84. Places outside its range are NaN. Throws InputError(name) unless
/// is_crs() is true.
std::vector<Geodetic> geodetic_of(const std::string& crs, std::span<const Eigen::Vector2d> places);

}  // namespace diurna
