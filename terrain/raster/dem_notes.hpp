#pragma once

#include "terrain/raster/dem.hpp"

namespace diurna {

/// Warnings about a raster's position, added to its notes.

/// Notes the distance of the raster's datum from WGS84 if PROJ has no transformation: latitude and
/// longitude are then used unchanged.
void note_datum(Dem& dem);
/// Notes a raster that is far from the UTM zone it names. A wrong neighbour zone with plausible
/// eastings cannot be detected.
void note_zone(Dem& dem);

}  // namespace diurna
