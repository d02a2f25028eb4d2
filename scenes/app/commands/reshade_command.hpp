#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna reshade`: a run's pictures with other paint, emissivity or temperature of an object.
void add_reshade_verb(CLI::App& app);

}  // namespace diurna
