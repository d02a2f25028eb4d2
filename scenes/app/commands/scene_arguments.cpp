#include "scenes/app/commands/scene_arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "materials/base/parallel.hpp"
#include "scenes/app/commands/number_option.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/memory_limit.hpp"
#include "scenes/job/run/rounds.hpp"

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

void take_rounds(const std::filesystem::path& temperatures, std::vector<std::string>& settings) {
    const std::vector<std::string> added = rounds_of_temperatures(temperatures, settings);
    if (added.empty()) return;
    settings.insert(settings.end(), added.begin(), added.end());
    fmt::print(stderr, "note: {} was computed with rounds: {} {} taken from its manifest\n",
               temperatures.string(), fmt::join(added, ", "), added.size() == 1 ? "is" : "are");
}

void tell_of_sweep(const Scene& scene) {
    if (scene.sweep.axes.empty()) return;
    fmt::print(stderr,
               "note: the [sweep] is ignored here: the scene's own values are used; diurna run "
               "computes the variants\n");
}

void add_choice(CLI::App& verb, const std::shared_ptr<std::vector<std::string>>& only,
                const std::string& more) {
    verb.add_option("--only", *only,
                    "render only these pictures: observer=NAME, band=NAME, frames=05:00..09:00 "
                    "(both ends included; or instants)" +
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

void add_checks(CLI::App& verb, const std::shared_ptr<SceneArguments>& arguments) {
    whole_within(verb.add_option_function<int>(
                     "--checks",
                     [arguments](int count) {
                         arguments->settings.push_back(fmt::format("scene.check_points={}", count));
                     },
                     "places in pictures to solve separately, to measure the error of the "
                     "temperatures there (default: scene.check_points)"),
                 0, 4096);
}

void add_common_options(CLI::App& verb, SceneArguments& arguments) {
    whole_within(verb.add_option("--threads", arguments.threads,
                                 "number of worker threads; 0: one per core"),
                 0, 1024);
    verb.add_option("--progress", arguments.progress, "progress messages: json, none or auto")
        ->check(CLI::IsMember({"json", "none", "auto"}));
    verb.add_flag("--allow-outside", arguments.allow_outside,
                  "permit input files outside the scene's folder and the program's data");
}

std::shared_ptr<SceneArguments> scene_arguments(CLI::App& verb) {
    auto a = std::make_shared<SceneArguments>();
    verb.add_option("SCENE", a->scene, "scene file (TOML)")->required();
    verb.add_option(
        "--set", a->settings,
        "KEY=VALUE replaces a value of the scene: observer.east.width=320 (or observer.0.width); "
        "lists and texts as in the file, single words without quotes");
    add_common_options(verb, *a);
    return a;
}

}  // namespace diurna
