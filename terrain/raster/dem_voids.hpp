#pragma once

#include <vector>

#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// Counts and marks the posts without height, then refuses, leaves or fills them. Throws InputError
/// if they are to be refused, or if no post has a height.
void apply_void_policy(Dem& dem, VoidPolicy policy);

/// Replaces NaN in a grid (row, column) of which at least one value is valid. Each void takes the
/// value of the finest grid of averages over 2 × 2, 4 × 4 ... cells that knows one, interpolated
/// between that grid's centres: continuous at the void's border to about one post, smooth within.
void fill_voids(int columns, int rows, std::vector<float>& height);

}  // namespace diurna
