#pragma once

namespace CLI {
class App;
}

namespace diurna {

void add_audit_verb(CLI::App& app);

}  // namespace diurna
