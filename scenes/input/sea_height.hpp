#pragma once

#include "scenes/input/read_elevation.hpp"

namespace diurna {

/// The sea above the ellipsoid [m] at a place: EGM96's geoid where the elevation's heights are over
/// it (terrain.vertical_datum), else 0, the sea being where the raster's heights are zero.
double sea_at(const SceneFrame& frame, const Geodetic& place);

}  // namespace diurna
