#pragma once

#include <string>

#include "scenes/job/keys/key_book.hpp"

namespace diurna {

/// scenes/KEYS.md: the keys of scene files, column files and materials, a Markdown table for each
/// table of the files.
std::string keys_page(const KeyBook& book);

}  // namespace diurna
