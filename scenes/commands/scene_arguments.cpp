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
    fmt::print(stderr,
               "note: the [sweep] is ignored here: the scene's own values are used; diurna run "
               "computes the variants\n");
}

void add_choice(CLI::App& verb, const std::shared_ptr<std::vector<std::string>>& only,
                const std::string& more) {
    verb.add_option(
        "--only", *only,
        "render only these pictures: observer=NAME, band=NAME, frames=05:00..09:00 (or instants)" +
            more);
    verb.add_option_function<std::vector<std::string>>(
        "--band",
        [only](const std::vector<std::string>& bands) {
            for (const std::string& band : bands) only->push_back("band=" + band);
        },
        "short form of --only band=NAME");
}

std::shared_ptr<SceneArguments> solving_arguments(CLI::App& verb) {
    auto a = scene_arguments(verb);
    verb.add_option(
        "--max-memory", a->max_memory,
        "largest memory that the plan may need, such as 6.5G (default: 90 % of the free memory)");
    verb.add_flag(
        "--fresh", a->fresh,
        "recompute everything, without the cache of earlier runs (DIURNA_STAGES, ~/.cache/diurna)");
    return a;
}

std::shared_ptr<SceneArguments> scene_arguments(CLI::App& verb) {
    auto a = std::make_shared<SceneArguments>();
    verb.add_option("SCENE", a->scene, "scene file (TOML)")->required();
    verb.add_option(
        "--set", a->settings,
        "KEY=VALUE replaces a value of the scene: observer.east.width=320 (or observer.0.width); "
        "lists and texts are written as in the file; single words need no quotes");
    whole_within(
        verb.add_option("--threads", a->threads, "number of worker threads; 0: one per core"), 0,
        1024);
    verb.add_option("--progress", a->progress,
                    "progress messages: auto (a line per stage; on a terminal one renewed line), "
                    "json (an object per line), or none")
        ->check(CLI::IsMember({"json", "none", "auto"}));
    verb.add_flag("--allow-outside", a->allow_outside,
                  "permit input files outside the scene's folder and the program's data");
    return a;
}

}  // namespace diurna
