#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna contrast`: how targets stand out from what is around them.
void add_contrast_verb(CLI::App& app);

}  // namespace diurna
