#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// calibrate: numbers of a column file found from a measured curve.
void add_calibrate_verb(CLI::App& app);

}  // namespace diurna
