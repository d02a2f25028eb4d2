#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// What is known of a scene before anything is computed: its mistakes and warnings, and its plan.
void add_check_verb(CLI::App& app);
void add_plan_verb(CLI::App& app);

}  // namespace diurna
