#pragma once

#include <string>
#include <vector>

#include "scenes/studies/sensitivity.hpp"

namespace diurna {

/// A line for each output and uncertain number: its effect alone and by elementary effects. In K or
/// hours; a field is empty without a crossover.
std::string sensitivity_csv(const SensitivityInput& input, const SensitivityReport& report);

std::string sensitivity_json(const SensitivityInput& input, const SensitivityReport& report,
                             const std::vector<std::string>& notes);

/// For each output bars of the effect of each number over its range: one at a time as |high - low|,
/// and mu* with twice its standard error.
std::string sensitivity_svg(const SensitivityInput& input, const SensitivityReport& report);

/// "K" or "h".
const char* unit_of(const SensitivityOutput& output);

}  // namespace diurna
