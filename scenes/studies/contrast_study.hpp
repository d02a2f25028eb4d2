#pragma once

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// Contrast of targets and treatments with their background: every [[contrast]] of the scene.
/// Throws InputError.
StudyFindings contrast_study(const StudyRequest& request);

}  // namespace diurna
