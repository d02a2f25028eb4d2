#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna mesh`: an elevation raster as triangles within a vertical tolerance.
void add_mesh_verb(CLI::App& app);

/// `diurna visibility`: sky view (and, for a given sun, the sunlit share) of every post by the
/// march over the raster.
void add_visibility_verb(CLI::App& app);

}  // namespace diurna
