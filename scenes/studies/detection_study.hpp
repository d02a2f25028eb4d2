#pragma once

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// Ranges at which an instrument's display shows objects: every [[detection]] of the scene. Throws
/// InputError.
StudyFindings detection_study(const StudyRequest& request);

}  // namespace diurna
