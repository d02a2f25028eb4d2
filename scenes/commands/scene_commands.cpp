#include "scenes/commands/scene_commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/plain_text.hpp"
#include "scenes/commands/scene_arguments.hpp"
#include "scenes/commands/told_lines.hpp"
#include "scenes/doubts/doubts.hpp"
#include "scenes/plan/frame_files.hpp"
#include "scenes/plan/memory_limit.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/run/found_heat.hpp"
#include "scenes/run/frames.hpp"
#include "scenes/run/heat.hpp"
#include "scenes/run/job.hpp"
#include "scenes/run/picture_shares.hpp"
#include "scenes/run/run_folder.hpp"
#include "scenes/sweep/run_sweep.hpp"
#include "scenes/sweep/sweep_plan.hpp"
#include "scenes/sweep/variants.hpp"

namespace diurna {

namespace {

/// Results that have not converged are kept, but the program fails.
void check_converged(const std::string& not_converged) {
    if (!not_converged.empty()) throw std::runtime_error(not_converged);
}

/// What `run` has besides a scene: of a sweep, which variants.
struct RunArguments {
    JobOptions job;
    std::string shard, only;
};

/// "2/4"
void read_shard(const std::string& text, SweepOptions& options) {
    int used = 0;
    if (std::sscanf(text.c_str(), "%zu/%zu%n", &options.shard, &options.shards, &used) != 2 ||
        std::size_t(used) != text.size() || options.shard < 1 || options.shard > options.shards) {
        throw InputError("--shard",
                         fmt::format("found '{}', expected I/N with I from 1 to N", text));
    }
}

void run_sweep_verb(const Sweep& sweep, const RunArguments& run, ProgressStyle style) {
    SweepOptions options{.out = run.job.out,
                         .resume = run.job.resume,
                         .max_memory = run.job.max_memory,
                         .progress = style};
    if (!run.shard.empty()) read_shard(run.shard, options);
    const SweepReport report = run_sweep(sweep, options);
    fmt::print("{}: {} variants rendered, {} kept, {} heats solved: {}\n", count_told(sweep),
               report.rendered, report.kept, report.solved, options.out.string());
    print_notes(report.notes);
    if (report.missing > 0) {
        fmt::print(stderr,
                   "note: {} variants are not there yet: whichever shard ends last writes "
                   "annotations.json and manifest.json of all\n",
                   report.missing);
    }
    if (!report.not_converged.empty()) {
        throw std::runtime_error(fmt::format("{}", fmt::join(report.not_converged, "\n")));
    }
}

/// One variant as a scene of its own.
Scene only_variant(const Sweep& sweep, const std::string& name, JobOptions& job) {
    std::vector<std::string> names;
    for (const Variant& variant : sweep.variants) {
        names.push_back(variant.name);
        if (variant.name == name) {
            job.settings.push_back("variant " + name);  // counts in the run's key
            return scene_of(sweep, variant);
        }
    }
    throw InputError("--only", fmt::format("no variant '{}', expected {} to {}, or base", name,
                                           names.front(), names.back()));
}

void run_verb(const SceneArguments& a, RunArguments run) {
    Scene scene = a.read();
    JobOptions& job = run.job;
    job.settings = a.settings;
    job.progress = a.style();
    job.stages = a.stages();
    job.max_memory = a.memory();
    if (scene.sweep.axes.empty()) {
        for (const auto& [option, text] : {std::pair{"--shard", run.shard}, {"--only", run.only}}) {
            if (!text.empty()) throw InputError(option, "the scene has no [sweep]");
        }
    } else if (run.only != "base") {
        const Sweep sweep = read_sweep_variants(a.scene, a.settings, a.allow_outside);
        if (run.only.empty()) {
            run_sweep_verb(sweep, run, a.style());
            return;
        }
        scene = only_variant(sweep, run.only, job);
    }
    const JobReport report = run_job(std::move(scene), job);
    double seconds = 0.0;
    for (const auto& stage : report.stages) seconds += stage.seconds;
    fmt::print("{} facets, {} frames rendered, {} files, {:.1f} s: {}\n", report.plan.facets,
               report.frames_rendered, report.files.size(), seconds,
               (job.out / "report.html").string());
    print_warnings(report.warnings);
    print_notes(report.notes);
    print_notes(report.remade);
    if (!report.start.empty()) fmt::print(stderr, "note: start: {}\n", plain(report.start));
    check_converged(report.not_converged);
}

void tell_taken(const Stages& stages) {
    if (std::string told = taken_told(stages.store()); !told.empty())
        print_notes({std::move(told)});
}

/// Of verbs that know no variants.
void tell_of_sweep(const Scene& scene) {
    if (scene.sweep.axes.empty()) return;
    fmt::print(stderr, "note: the scene as it stands; its [sweep] is for run\n");
}

void solve_verb(const SceneArguments& a, const std::filesystem::path& out) {
    check_output_file(out);
    const double most = a.memory();
    const Prepared prepared = prepare(a.read());
    check_output_file(out, prepared.scene.files);
    check_memory(prepared.plan, most);
    tell_of_sweep(prepared.scene);
    print_warnings(as_lines(doubts(prepared)));
    Progress progress(a.style());
    progress.stage("sky view");
    const Stages stages(prepared, a.stages());
    stages.at(0);
    const auto inputs =
        stages.store() == nullptr ? std::vector<RunInput>{} : run_inputs(prepared.scene);
    const SceneHeat heat = scene_heat(stages, inputs, progress, 0.0);
    progress.finish();
    write_heat(prepared, heat.result, out);
    print_notes(prepared.notes);
    print_notes(told_as("note", heat));
    tell_taken(stages);
    for (const std::string& start : told_as("start", heat)) print_notes({"start: " + start});
    check_converged(told_as("not converged", heat).front());
}

/// Throws InputError for pictures of facets that another run left to others of their kind.
void check_solved(const Stages& stages, const TemperatureField& field,
                  const std::filesystem::path& temperatures) {
    if (field.solved_as.empty()) return;
    const std::vector<float> share = picture_shares(stages);
    float most = 0.0f;
    for (std::size_t f = 0; f < share.size(); ++f) {
        if (field.solved_as[f] != f) most = std::max(most, share[f]);
    }
    if (most == 0.0f) return;
    throw InputError(temperatures.string(),
                     fmt::format("was solved for other pictures (tolerance_K): of these a facet "
                                 "that fills {:.2g} % of one was left to others of its kind",
                                 100.0f * most),
                     "run the scene with these observers, or solve it without tolerance_K");
}

void render_verb(const SceneArguments& a, const std::filesystem::path& temperatures,
                 const std::filesystem::path& out) {
    check_run_folder(out, FolderKind::run);
    const double most = a.memory();
    const Prepared prepared = prepare(a.read());
    check_memory(prepared.plan, most);
    tell_of_sweep(prepared.scene);
    const std::vector<RunInput> inputs = run_inputs(prepared.scene);
    check_no_input_in(out, inputs);
    check_no_input_in(out, {{temperatures, "", ""}});
    const TemperatureField field = load_temperature_field(temperatures);
    if (field.facets != prepared.world.surfaces().size()) {
        throw InputError(temperatures.string(),
                         fmt::format("found temperatures of {} facets, expected {} as in the scene",
                                     field.facets, prepared.world.surfaces().size()));
    }
    check_covers(field, prepared.plan.frames, temperatures);
    const FolderLock lock(out);
    const std::size_t gone = clear_run_folder(out, {}, frame_files(prepared.scene));
    if (gone > 0) fmt::print(stderr, "note: {} files of earlier runs removed\n", gone);
    std::filesystem::create_directories(out / "frames");
    Progress progress(a.style());
    progress.stage("sky view");
    const Stages stages(prepared, a.stages());
    stages.at(0);
    tell_taken(stages);
    check_solved(stages, field, temperatures);
    const FramesReport report = render_frames(stages, field, out, progress);
    for (const auto& notes : {report.notes, report.warnings}) print_notes(notes);
}

}  // namespace

void add_run_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("run", "the whole job: temperatures, frames, report");
    const auto a = solving_arguments(*verb);
    const auto run = std::make_shared<RunArguments>();
    verb->add_option("--out", run->job.out, "folder for the results (default: out)");
    verb->add_flag("--resume", run->job.resume, "keep what an earlier run of the same inputs left");
    verb->add_option("--shard", run->shard, "I/N: of a sweep, this part of its variants");
    verb->add_option("--only", run->only,
                     "of a sweep, this variant as a run by itself; base: the scene as it stands");
    verb->callback([a, run] { run_verb(*a, *run); });
}

void add_solve_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("solve", "temperatures alone");
    const auto a = solving_arguments(*verb);
    const auto out = std::make_shared<std::filesystem::path>();
    verb->add_option("--out", *out, "netCDF file")->required();
    verb->callback([a, out] { solve_verb(*a, *out); });
}

void add_render_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("render", "frames from given temperatures");
    const auto a = solving_arguments(*verb);
    const auto temperatures = std::make_shared<std::filesystem::path>();
    const auto out = std::make_shared<std::filesystem::path>("out");
    verb->add_option("--temperatures", *temperatures, "netCDF file of `solve`")->required();
    verb->add_option("--out", *out, "folder for the results (default: out)");
    verb->callback([a, temperatures, out] { render_verb(*a, *temperatures, *out); });
}

}  // namespace diurna
