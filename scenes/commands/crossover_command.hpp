#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna crossover`: when things look equally warm.
void add_crossover_verb(CLI::App& app);

}  // namespace diurna
