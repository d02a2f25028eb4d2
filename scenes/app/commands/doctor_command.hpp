#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna doctor`: versions, instruction sets, threads, data folders.
void add_doctor_verb(CLI::App& app);

}  // namespace diurna
