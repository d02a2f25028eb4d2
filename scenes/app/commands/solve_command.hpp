#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// Computes only the temperatures of a scene, into a file. Throws InputError for unusable input.
void add_solve_verb(CLI::App& app);

}  // namespace diurna
