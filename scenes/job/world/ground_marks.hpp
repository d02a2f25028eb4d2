#pragma once

#include "scenes/job/world/world.hpp"
#include "terrain/raster/dem.hpp"

/// Marks of ground facets by their position.
namespace diurna {

/// Marks the ground facets on details of the raster, which the relief does not include.
void mark_details(World& world, const Dem& dem);

/// Marks the ground facets whose elevation was filled in.
void mark_filled(World& world, const Dem& dem);

}  // namespace diurna
