#include "scenes/app/commands/printed_lines.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "materials/base/plain_text.hpp"

namespace diurna {

void print_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", plain(note));
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& line : warnings) fmt::print(stderr, "warning: {}\n", plain(line));
}

}  // namespace diurna
