#pragma once

#include <string>
#include <utility>
#include <vector>

namespace diurna {

/// What was reported when results were found, by name: for the report of a run that takes them
/// over.
using Messages = std::vector<std::pair<std::string, std::string>>;

}  // namespace diurna
