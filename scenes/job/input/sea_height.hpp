#pragma once

#include "scenes/job/input/read_elevation.hpp"

namespace diurna {

/// Height of the sea above the ellipsoid [m] at a place: EGM96's geoid if the elevation's heights
/// are converted (terrain.vertical_datum), else 0, with the sea at height zero of the raster.
double sea_at(const SceneFrame& frame, const Geodetic& place);

}  // namespace diurna
