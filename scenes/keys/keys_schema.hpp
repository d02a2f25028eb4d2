#pragma once

#include <string>

#include "scenes/keys/key_book.hpp"

namespace diurna {

/// A JSON Schema (draft 2020-12) that accepts scene files and column files, read as TOML: $defs has
/// one of each. It knows types, ranges, words and misspelt keys; what keys have to do with each
/// other only the readers know.
std::string keys_schema(const KeyBook& book);

}  // namespace diurna
