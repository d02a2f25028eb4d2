#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// The whole job of a scene or of a sweep, a part of it, its pictures from temperatures that are
/// there, and the whole of such parts. Throws InputError for what it cannot use.
void add_run_verb(CLI::App& app);
void add_render_verb(CLI::App& app);
void add_merge_verb(CLI::App& app);

}  // namespace diurna
