#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna sensitivity`: what uncertain numbers do to figures of a scene.
void add_sensitivity_verb(CLI::App& app);

}  // namespace diurna
