#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna new`: writes a first scene for an elevation raster.
void add_new_verb(CLI::App& app);

}  // namespace diurna
