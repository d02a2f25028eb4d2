#pragma once

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// The key `layers` of a material, from the surface down: layers of given constants, of soil
/// (materials/matter/soil.hpp) or of regolith. Mistakes are noted.
///
/// fresh  the material starts from no other material, so layers are required
void read_layers(const Section& section, bool fresh, ThermalSurface& thermal);

}  // namespace diurna
