#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna model [NAME] [--detail low|medium|high] [--out FILE.obj]`: the objects that the program
/// builds itself; one written as OBJ, its part file beside it.
void add_model_verb(CLI::App& app);

}  // namespace diurna
