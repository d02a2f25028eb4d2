#pragma once

#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// Counts and marks the posts without height, then refuses, leaves or fills them: with averages of
/// ever coarser grids, from the finest one that has a value. Throws InputError if they are to be
/// refused, or if no post has a height.
void apply_void_policy(Dem& dem, VoidPolicy policy);

}  // namespace diurna
