#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna pages --man | --bash | --bill`: the manual page, the shell completion, and the software
/// bill of materials, for packages.
void add_pages_verb(CLI::App& app);

}  // namespace diurna
