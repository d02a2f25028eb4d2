#pragma once

#include "scenes/input/checked_names.hpp"
#include "scenes/input/scene.hpp"

namespace diurna {

/// The section [atmosphere].
AirInput read_air(const Section& section, const Reading& reading);

/// If the air is a table of paths, every band and cube of the scene needs its bins in it and, as
/// tables have no scattered sun, has to begin at 3 µm or more: mistakes of `section` otherwise.
void check_table_bands(const Section& section, const Scene& scene);

}  // namespace diurna
