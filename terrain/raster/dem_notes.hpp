#pragma once

#include "terrain/raster/dem.hpp"

namespace diurna {

/// Warnings about a raster's position, added to its notes.

/// Notes a shift of the raster's datum to WGS84 of 2 m or more, and a datum whose shift is unknown:
/// latitude and longitude are then used unchanged. Datums that agree with WGS84 within a few metres
/// (realisations of ITRS: ETRS89, NAD83, GDA94, ...) have no note.
void note_datum(Dem& dem);
/// Notes a raster that is far from the UTM zone it names. A wrong neighbour zone with plausible
/// eastings cannot be detected.
void note_zone(Dem& dem);

}  // namespace diurna
