#pragma once

#include <array>

#include "thermal/steppers/layered_batch.hpp"
#include "thermal/steppers/material_column.hpp"
#include "thermal/steppers/step_record.hpp"

namespace diurna {

/// Advances a batch by one (sub)step: two implicit stages, each with its own air and heat (absorbed
/// sun and longwave, internal) [lane] [W m⁻²], at step · γ and at the step's end. Thin plates with
/// air behind use thermal/steppers/layered_plate.hpp.
void advance(const MaterialColumn& material, const std::array<AirFilm, 2>& air,
             const std::array<const double*, 2>& heat, LayeredBatch& batch, StepRecord& record);

/// The steady state under constant air and heat, as a first guess. Returns −Σ over lanes of the
/// surface's slope in it [W m⁻² K⁻¹].
double settle(const MaterialColumn& material, const AirFilm& air, const double* heat,
              LayeredBatch& batch);

}  // namespace diurna
