#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna export RUN_FOLDER --to csv|vtu|geotiff|ply|kmz --out PATH`
void add_export_verb(CLI::App& app);

}  // namespace diurna
