#pragma once

#include <map>
#include <string>

namespace diurna {

/// What people call some of the library's materials: (word, its name here). "tarmac" is "asphalt".
const std::map<std::string, std::string>& everyday_words();

}  // namespace diurna
