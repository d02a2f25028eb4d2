#pragma once

namespace CLI {
class App;
}

/// The verbs that work on a scene file. Each prints to stdout what it has found and throws
/// InputError for what it cannot use.
namespace diurna {

void add_solve_verb(CLI::App& app);
void add_render_verb(CLI::App& app);

}  // namespace diurna
