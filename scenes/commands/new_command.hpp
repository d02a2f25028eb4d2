#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna new`: a first scene of a place, made of its elevation.
void add_new_verb(CLI::App& app);

}  // namespace diurna
