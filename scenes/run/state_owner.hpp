#pragma once

#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "thermal/solve/heat_state_file.hpp"

namespace diurna {

/// Whose heat the facets of a scene hold: their mesh by a digest, and what lies below each material
/// they are of. Surfaces may change from run to run (albedo, emissivity, evaporation), columns may
/// not.
StateOwner state_owner(const FacetSet& facets, const MaterialLibrary& materials);

}  // namespace diurna
