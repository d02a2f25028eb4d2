#pragma once

#include <CLI/CLI.hpp>

namespace diurna {

/// `diurna verify DIR`
void add_verify_verb(CLI::App& app);

}  // namespace diurna
