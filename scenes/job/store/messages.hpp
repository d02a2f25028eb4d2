#pragma once

#include <string>
#include <utility>
#include <vector>

namespace diurna {

/// Messages of a computation, by name: for the
/// report of a run that takes its results from the
/// cache.
using Messages = std::vector<std::pair<std::string, std::string>>;

}  // namespace diurna
