#pragma once

#include <string>

#include "scenes/job/keys/key_book.hpp"

namespace diurna {

/// A JSON Schema (draft 2020-12) that accepts scene files and column files, read as TOML: $defs has
/// one of each. It covers types, ranges, words and misspelt keys; relations between keys are
/// checked only by the readers.
std::string keys_schema(const KeyBook& book);

}  // namespace diurna
