#pragma once

namespace CLI {
class App;
}

namespace diurna {

void add_detection_verb(CLI::App& app);

}  // namespace diurna
