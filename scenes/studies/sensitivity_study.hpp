#pragma once

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// Effect of uncertain numbers on results of a scene: every [[sensitivity]] of the scene. The
/// results need the heat balance at every step, so a file of temperatures cannot be used. Throws
/// InputError.
StudyFindings sensitivity_study(const StudyRequest& request);

}  // namespace diurna
