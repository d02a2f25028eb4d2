#pragma once

#include <map>
#include <string>

namespace diurna {

/// Everyday names of some of the library's materials: (word, name here). "tarmac" is "asphalt".
const std::map<std::string, std::string>& everyday_words();

}  // namespace diurna
