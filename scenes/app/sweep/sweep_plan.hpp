#pragma once

#include <string>

#include "scenes/app/sweep/variants.hpp"
#include "scenes/job/plan/plan.hpp"

namespace diurna {

/// In one line: "12 variants of 48 combinations, 3 solves of the heat balance".
std::string count_reported(const Sweep& sweep);

/// Text of `diurna plan` for a sweep: its variants, heats and seconds, from the plan of the
/// unchanged scene.
std::string describe(const Sweep& sweep, const Plan& base);

}  // namespace diurna
