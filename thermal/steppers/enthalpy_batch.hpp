#pragma once

#include "thermal/steppers/enthalpy_lanes.hpp"
#include "thermal/surface/surface_conditions.hpp"

namespace diurna {

/// One step. Lanes whose equations did not converge are unchanged.
LaneMask advance(const EnthalpyForcing& forcing, EnthalpyBatch& batch);

/// The conditions of one lane, for its terms by name: at the end of the last step as used in it, or
/// (`now`) the present ones.
SurfaceConditions conditions_of(const EnthalpyBatch& batch, const EnthalpyForcing& forcing,
                                std::size_t lane, bool now = false);

}  // namespace diurna
