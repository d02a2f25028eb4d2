#pragma once

#include <string>

#include "scenes/plan/plan.hpp"
#include "scenes/sweep/variants.hpp"

namespace diurna {

/// In one line: "12 variants of 48 combinations, 3 solves of the heat balance".
std::string count_reported(const Sweep& sweep);

/// What `diurna plan` reports of a sweep: its variants, heats and seconds, by the plan of the scene
/// as it stands.
std::string describe(const Sweep& sweep, const Plan& base);

}  // namespace diurna
