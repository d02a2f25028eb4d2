#pragma once

#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "thermal/solve/heat_state_file.hpp"

namespace diurna {

/// Identifies the facets of a state: their mesh by a digest, and the layers below each of their
/// materials. Surfaces may change from run to run (albedo, emissivity, evaporation), columns may
/// not.
StateOwner state_owner(const FacetSet& facets, const MaterialLibrary& materials);

}  // namespace diurna
