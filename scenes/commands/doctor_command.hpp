#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna doctor`: versions, instruction sets, threads, where data are found.
void add_doctor_verb(CLI::App& app);

}  // namespace diurna
