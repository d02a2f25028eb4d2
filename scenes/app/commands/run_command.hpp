#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// The whole job of a scene or of a sweep, a shard of it, its pictures from existing temperatures,
/// or the merging of shards. Throws InputError for unusable input.
void add_run_verb(CLI::App& app);
void add_render_verb(CLI::App& app);
void add_merge_verb(CLI::App& app);

}  // namespace diurna
