#pragma once

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// Radiant and contrast intensity of objects in every direction: every [[signature]] of the scene.
/// Throws InputError.
StudyFindings signature_study(const StudyRequest& request);

}  // namespace diurna
