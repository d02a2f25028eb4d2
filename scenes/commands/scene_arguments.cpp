#include "scenes/commands/scene_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "materials/base/parallel.hpp"
#include "scenes/commands/number_option.hpp"
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

double SceneArguments::memory() const {
    return max_memory.empty() ? 0.0 : bytes_reported(max_memory);
}

void tell_of_sweep(const Scene& scene) {
    if (scene.sweep.axes.empty()) return;
    fmt::print(stderr, "note: the scene as it stands; its [sweep] is for run\n");
}

void add_choice(CLI::App& verb, const std::shared_ptr<std::vector<std::string>>& only,
                const std::string& more) {
    verb.add_option("--only", *only,
                    "observer=NAME, band=NAME, frames=05:00..09:00 (or instants): these pictures "
                    "alone" +
                        more);
    verb.add_option_function<std::vector<std::string>>(
        "--band",
        [only](const std::vector<std::string>& bands) {
            for (const std::string& band : bands) only->push_back("band=" + band);
        },
        "short for --only band=NAME");
}

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
    verb.add_option("--set", a->settings,
                    "key.path=value in place of what the file says: observer.east.width=320 (or "
                    "observer.0.width); lists and texts as in the file, a word needs no quotes");
    whole_within(verb.add_option("--threads", a->threads, "worker threads; 0: one per core"), 0,
                 1024);
    verb.add_option("--progress", a->progress, "json, none or auto")
        ->check(CLI::IsMember({"json", "none", "auto"}));
    verb.add_flag("--allow-outside", a->allow_outside,
                  "read files beyond the scene's folder and the program's data");
    return a;
}

}  // namespace diurna
