#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna pages --man | --bash | --bill`: the manual page, what a shell completes, and the bill
/// of materials, for packages.
void add_pages_verb(CLI::App& app);

}  // namespace diurna
