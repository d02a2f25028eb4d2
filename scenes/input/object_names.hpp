#pragma once

#include "materials/base/section.hpp"
#include "scenes/input/read_terrain.hpp"

namespace diurna {

/// Adds objects to the names that a key may give, each copy by its own. The name that copies have
/// in common is taken out: beside it stands what they are called.
void add_objects(Names& names, const TerrainInput& terrain);

}  // namespace diurna
