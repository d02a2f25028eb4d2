#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna model [NAME] [--detail low|medium|high] [--out FILE.obj]`: the program's built-in
/// models; writes one as OBJ, with its part file beside it.
void add_model_verb(CLI::App& app);

}  // namespace diurna
