#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna check`: a scene's mistakes and warnings, and its plan, without computing anything.
void add_check_verb(CLI::App& app);
void add_plan_verb(CLI::App& app);

}  // namespace diurna
