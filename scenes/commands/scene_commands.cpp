#include "scenes/commands/scene_commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/run/frames.hpp"
#include "scenes/run/heat.hpp"
#include "scenes/run/job.hpp"

namespace diurna {

namespace {

/// Options that verbs working on a scene share.
struct SceneArguments {
    std::filesystem::path scene;
    std::vector<std::string> settings;
    std::string progress;
    int threads = 0;

    Scene read() const {
        set_thread_count(threads);
        return read_scene(scene, settings);
    }
    ProgressStyle style() const {
        if (progress == "json") return ProgressStyle::json;
        if (progress == "none") return ProgressStyle::silent;
        return default_progress_style();
    }
};

/// The arguments of a verb, read into what is returned.
std::shared_ptr<SceneArguments> scene_arguments(CLI::App& verb) {
    auto a = std::make_shared<SceneArguments>();
    verb.add_option("SCENE", a->scene, "scene file (TOML)")->required();
    verb.add_option("--set", a->settings, "key.path=value in place of what the file says");
    verb.add_option("--threads", a->threads, "worker threads; 0: one per core")
        ->check(CLI::Range(0, 1024));
    verb.add_option("--progress", a->progress, "json, none or auto")
        ->check(CLI::IsMember({"json", "none", "auto"}));
    return a;
}

/// Results that have not converged are kept, but the program fails.
void check_converged(const std::string& not_converged) {
    if (!not_converged.empty()) throw std::runtime_error(not_converged);
}

void check_verb(const SceneArguments& a) {
    const Prepared prepared = prepare(a.read());
    check_start(prepared);
    fmt::print("{}: fine, {} facets, {} observers\n", a.scene.string(),
               prepared.world.surfaces().size(), prepared.sequences.size());
    for (const std::string& note : prepared.notes) fmt::print(stderr, "note: {}\n", note);
}

void run_verb(const SceneArguments& a, JobOptions job) {
    job.settings = a.settings;
    job.progress = a.style();
    const JobReport report = run_job(a.read(), job);
    double seconds = 0.0;
    for (const auto& stage : report.stages) seconds += stage.seconds;
    fmt::print("{} facets, {} frames rendered, {} files, {:.1f} s: {}\n", report.plan.facets,
               report.frames_rendered, report.files.size(), seconds,
               (job.out / "report.html").string());
    for (const std::string& note : report.notes) fmt::print(stderr, "note: {}\n", note);
    if (!report.start.empty()) fmt::print(stderr, "note: start: {}\n", report.start);
    check_converged(report.not_converged);
}

void solve_verb(const SceneArguments& a, const std::filesystem::path& out) {
    const Prepared prepared = prepare(a.read());
    Progress progress(a.style());
    progress.stage("sky view");
    const Stages stages(prepared);
    stages.at(0);
    const SpanResult result = solve_scene(stages, progress);
    progress.finish();
    write_heat(prepared, result, out);
    for (const std::string& note : prepared.notes) fmt::print(stderr, "note: {}\n", note);
    for (const std::string& note : result.notes) fmt::print(stderr, "note: {}\n", note);
    fmt::print(stderr, "note: start: {}\n", result.start);
    check_converged(not_converged(result.report));
}

void render_verb(const SceneArguments& a, const std::filesystem::path& temperatures,
                 const std::filesystem::path& out) {
    const Prepared prepared = prepare(a.read());
    const TemperatureField field = load_temperature_field(temperatures);
    if (field.facets != prepared.world.surfaces().size()) {
        throw InputError(temperatures.string(),
                         fmt::format("found temperatures of {} facets, expected {} as in the scene",
                                     field.facets, prepared.world.surfaces().size()));
    }
    std::filesystem::create_directories(out / "frames");
    Progress progress(a.style());
    progress.stage("sky view");
    const Stages stages(prepared);
    stages.at(0);
    render_frames(stages, field, out, progress);
}

}  // namespace

void add_check_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("check", "every mistake of a scene file at once");
    verb->callback([a = scene_arguments(*verb)] { check_verb(*a); });
}

void add_plan_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("plan", "what would be computed and what is skipped");
    verb->callback([a = scene_arguments(*verb)] {
        const Prepared prepared = prepare(a->read());
        fmt::print("{}", describe(prepared.plan));
        for (const std::string& note : prepared.notes) fmt::print(stderr, "note: {}\n", note);
    });
}

void add_run_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("run", "the whole job: temperatures, frames, report");
    const auto a = scene_arguments(*verb);
    const auto job = std::make_shared<JobOptions>();
    verb->add_option("--out", job->out, "folder for the results (default: out)");
    verb->add_flag("--resume", job->resume, "keep what an earlier run of the same inputs left");
    verb->callback([a, job] { run_verb(*a, *job); });
}

void add_solve_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("solve", "temperatures alone");
    const auto a = scene_arguments(*verb);
    const auto out = std::make_shared<std::filesystem::path>();
    verb->add_option("--out", *out, "netCDF file")->required();
    verb->callback([a, out] { solve_verb(*a, *out); });
}

void add_render_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("render", "frames from given temperatures");
    const auto a = scene_arguments(*verb);
    const auto temperatures = std::make_shared<std::filesystem::path>();
    const auto out = std::make_shared<std::filesystem::path>("out");
    verb->add_option("--temperatures", *temperatures, "netCDF file of `solve`")->required();
    verb->add_option("--out", *out, "folder for the results (default: out)");
    verb->callback([a, temperatures, out] { render_verb(*a, *temperatures, *out); });
}

}  // namespace diurna
