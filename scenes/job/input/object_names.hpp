#pragma once

#include "materials/base/section.hpp"
#include "scenes/job/input/read_terrain.hpp"

namespace diurna {

/// Adds objects to the names that a key may give, each copy by its own. The common name of copies
/// is not allowed; the remedy lists the copies' names.
void add_objects(Names& names, const TerrainInput& terrain);

}  // namespace diurna
