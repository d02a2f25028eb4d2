#pragma once

#include "terrain/raster/dem.hpp"

namespace diurna {

/// warnings about a raster's place that its reader should know; they go into its notes.

/// Notes how far the raster's datum lies from WGS84, if PROJ does not know the way: it then takes
/// latitude and longitude as they are.
void note_datum(Dem& dem);
/// Notes a raster that lies far from the UTM zone it names. A wrong neighbour zone with plausible
/// eastings cannot be reported.
void note_zone(Dem& dem);

}  // namespace diurna
