#pragma once

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// What numbers that are not known well do to figures of a scene: every [[sensitivity]] of the
/// scene. Its figures are of the heat balance at every step: a file of temperatures is no use.
/// Throws InputError.
StudyFindings sensitivity_study(const StudyRequest& request);

}  // namespace diurna
