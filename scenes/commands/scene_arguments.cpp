#include "scenes/commands/scene_arguments.hpp"

#include <CLI/CLI.hpp>

#include "materials/base/parallel.hpp"
#include "scenes/input/scene_file.hpp"

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
