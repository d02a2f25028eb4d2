#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna materials [NAME]`: the library's materials, or one with every number and its source;
/// also prints the pages materials/LIBRARY.md and materials/library.svg.
void add_materials_verb(CLI::App& app);

}  // namespace diurna
