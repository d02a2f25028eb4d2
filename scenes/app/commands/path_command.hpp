#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna path`: transmittance and radiance of one path through the air, by the embedded model or
/// by the user's MODTRAN 5.
void add_path_verb(CLI::App& app);

}  // namespace diurna
