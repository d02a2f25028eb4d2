#pragma once

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// When two things look equally warm, and how well that is known: every [[crossover]] of the scene.
/// Throws InputError.
StudyFindings crossover_study(const StudyRequest& request);

}  // namespace diurna
