#pragma once

#include <array>

#include "thermal/steppers/layered_batch.hpp"
#include "thermal/steppers/material_column.hpp"
#include "thermal/steppers/step_record.hpp"

namespace diurna {

/// A step as in thermal/steppers/layered_step.hpp for thin plates with two faces
/// (ThermalSurface::back): the last node exchanges heat with the air, through the film of its other
/// side, and radiation with the surroundings behind (LayeredBatch::behind), solved by Newton around
/// the front's own to 1e-9 K.
void advance_plate(const MaterialColumn& material, const std::array<AirFilm, 2>& air,
                   const std::array<const double*, 2>& heat, LayeredBatch& batch,
                   StepRecord& record);

}  // namespace diurna
