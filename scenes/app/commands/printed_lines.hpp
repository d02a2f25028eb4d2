#pragma once

#include <string>
#include <vector>

namespace diurna {

/// To stderr, a line each: "note: ...", without control characters.
void print_notes(const std::vector<std::string>& notes);

/// The same for warnings: "warning: ...".
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace diurna
