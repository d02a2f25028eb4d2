#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna inspect FILE [--json]`
void add_inspect_verb(CLI::App& app);

}  // namespace diurna
