#pragma once

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// Detection ranges of objects on an instrument's display: every [[detection]] of the scene. Throws
/// InputError.
StudyFindings detection_study(const StudyRequest& request);

}  // namespace diurna
