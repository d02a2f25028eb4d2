#pragma once

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// When two things have equal apparent temperature, with its uncertainty: every [[crossover]] of
/// the scene. Throws InputError.
StudyFindings crossover_study(const StudyRequest& request);

}  // namespace diurna
