#include "scenes/commands/scene_arguments.hpp"

#include <CLI/CLI.hpp>

#include "materials/base/parallel.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/plan/memory_limit.hpp"

namespace diurna {

Scene SceneArguments::read() const {
    set_thread_count(threads);
    return read_scene(scene, settings, allow_outside);
}

ProgressStyle SceneArguments::style() const {
    if (progress == "json") return ProgressStyle::json;
    if (progress == "none") return ProgressStyle::silent;
    return default_progress_style();
}

std::shared_ptr<const StageStore> SceneArguments::stages() const {
    return fresh ? nullptr : StageStore::of_user();
}

double SceneArguments::memory() const { return max_memory.empty() ? 0.0 : bytes_told(max_memory); }

std::shared_ptr<SceneArguments> solving_arguments(CLI::App& verb) {
    auto a = scene_arguments(verb);
    verb.add_option("--max-memory", a->max_memory,
                    "that the plan may need, 6.5G; else nine tenths of what the machine has free");
    verb.add_flag(
        "--fresh", a->fresh,
        "find all anew, whatever earlier runs have left (DIURNA_STAGES, ~/.cache/diurna)");
    return a;
}

std::shared_ptr<SceneArguments> scene_arguments(CLI::App& verb) {
    auto a = std::make_shared<SceneArguments>();
    verb.add_option("SCENE", a->scene, "scene file (TOML)")->required();
    verb.add_option("--set", a->settings, "key.path=value in place of what the file says");
    verb.add_option("--threads", a->threads, "worker threads; 0: one per core")
        ->check(CLI::Range(0, 1024));
    verb.add_option("--progress", a->progress, "json, none or auto")
        ->check(CLI::IsMember({"json", "none", "auto"}));
    verb.add_flag("--allow-outside", a->allow_outside,
                  "read files beyond the scene's folder and the program's data");
    return a;
}

}  // namespace diurna
