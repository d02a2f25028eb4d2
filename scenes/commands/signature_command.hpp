#pragma once

namespace CLI {
class App;
}

namespace diurna {

void add_signature_verb(CLI::App& app);

}  // namespace diurna
