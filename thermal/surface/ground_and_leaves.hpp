#pragma once

#include "thermal/surface/surface_conditions.hpp"

namespace diurna {

/// The surface's terms at a ground temperature: of bare ground, or of its canopy or snow
/// (thermal/surface/canopy.hpp).
SurfaceTerms surface_terms(const SurfaceConditions& conditions, double ground_temperature);

}  // namespace diurna
