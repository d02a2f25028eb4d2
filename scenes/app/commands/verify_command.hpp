#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna verify DIR`
void add_verify_verb(CLI::App& app);

}  // namespace diurna
