#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// calibrate: fits numbers of a column file to a measured curve.
void add_calibrate_verb(CLI::App& app);

}  // namespace diurna
