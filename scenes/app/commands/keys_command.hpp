#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna keys`: every key of scene files, column files and materials (scenes/KEYS.md), or their
/// JSON Schema.
void add_keys_verb(CLI::App& app);

}  // namespace diurna
