#pragma once

#include <string>
#include <utility>
#include <vector>

namespace diurna {

/// What was told when results were found, by name: for the report of a run that takes them over.
using Told = std::vector<std::pair<std::string, std::string>>;

}  // namespace diurna
