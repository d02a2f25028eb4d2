#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna column`: one facet driven by a weather file (thermal/point/point_job.hpp).
void add_column_verb(CLI::App& app);

}  // namespace diurna
