#pragma once

#include "scenes/job/plan/prepared.hpp"
#include "scenes/studies/study_request.hpp"

namespace diurna {

/// Throws InputError if [[uncertain]] values, a [[crossover]] or a [[sensitivity]] of the scene
/// could not be computed: an
/// uncertain key that is unknown or takes no number, a value outside its range, a region without
/// surface or pixels. Nothing is solved; each uncertain value is one reading of the scene file.
void check_studies(const Prepared& prepared, const StudyRequest& request);

}  // namespace diurna
