#pragma once

#include "terrain/raster/dem.hpp"

namespace diurna {

/// Warns about posts of exactly 0 that differ from the posts around them by far more than the
/// ground's own steps: voids without a declared no-data value, as gdalwarp leaves them around a
/// turned raster and in its holes.
///
/// Areas of zeros are judged one by one. The greatest height within two posts of each post of an
/// area's border must be over 100 m and over 4 times the step between neighbouring posts that 95 %
/// of the raster stays below, at 95 % of the border. Coasts, which have low shores, and fjords,
/// whose walls are no steeper than twice the other slopes, are no such areas; a raster with only
/// high cliffs along its sea can be.
void warn_of_zero_posts(Dem& dem);

}  // namespace diurna
