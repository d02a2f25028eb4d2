#pragma once

#include "scenes/world/world.hpp"
#include "terrain/raster/dem.hpp"

/// What is reported of each facet of the ground by where it lies.
namespace diurna {

/// Marks the ground facets on details of the raster: the relief does not know what they show.
void mark_details(World& world, const Dem& dem);

/// Marks the ground facets whose elevation was filled in.
void mark_filled(World& world, const Dem& dem);

}  // namespace diurna
