#pragma once

#include "terrain/ground/tin.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The network within the tolerance in no more memory than ten times the input and 200 MB for the
/// whole program, the input counted as two bytes a post. Where the greedy network with its queue
/// needs more (about 220 bytes a post of it), the full grid, which is exact and needs 65. Throws
/// InputError where that is too much too.
Tin affordable_tin(const Dem& dem, double tolerance);

}  // namespace diurna
