#pragma once

#include <span>
#include <vector>

#include "terrain/place/site.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// EGM96's geoid above the WGS84 ellipsoid [m], bilinear on its 15′ grid (PROJ's egm96_15).
/// Throws InputError if PROJ does not have the grid.
std::vector<double> geoid_heights(std::span<const Geodetic> places);

/// Converts heights above the sea to heights above the ellipsoid: the geoid at a lattice of posts
/// about 1 km apart, bilinear between.
void add_geoid(Dem& dem);

}  // namespace diurna
