#pragma once

#include "terrain/ground/tin.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The network within the tolerance, with at most ten times the memory of the input (two bytes a
/// post) plus 200 MB for the whole program. If the greedy network with its queue needs more (about
/// 220 bytes per post of it), the full grid is used, which is exact and needs 65. Throws InputError
/// if that needs too much as well.
Tin affordable_tin(const Dem& dem, double tolerance);

}  // namespace diurna
