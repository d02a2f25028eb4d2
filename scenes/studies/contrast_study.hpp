#pragma once

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// How targets and treatments stand out from what is around them: every [[contrast]] of the scene.
/// Throws InputError.
StudyFindings contrast_study(const StudyRequest& request);

}  // namespace diurna
