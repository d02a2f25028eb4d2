#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// Temperatures of a scene alone, into a file. Throws InputError for what it cannot use.
void add_solve_verb(CLI::App& app);

}  // namespace diurna
