#include "scenes/app/commands/run_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/plain_text.hpp"
#include "scenes/app/commands/printed_lines.hpp"
#include "scenes/app/commands/scene_arguments.hpp"
#include "scenes/app/sweep/run_sweep.hpp"
#include "scenes/app/sweep/sweep_plan.hpp"
#include "scenes/app/sweep/variants.hpp"
#include "scenes/job/plan/plan_text.hpp"
#include "scenes/job/run/job.hpp"

namespace diurna {

namespace {

/// What `run` has besides a scene.
struct RunArguments {
    JobOptions job;
    std::string shard;
    std::shared_ptr<std::vector<std::string>> only = std::make_shared<std::vector<std::string>>();
};

void run_sweep_verb(const Sweep& sweep, const RunArguments& run, ProgressStyle style) {
    const SweepOptions options{.out = run.job.out,
                               .resume = run.job.resume,
                               .shard = run.job.pictures.shard,
                               .max_memory = run.job.max_memory,
                               .progress = style};
    const SweepReport report = run_sweep(sweep, options);
    fmt::print("{}: {} rendered, {} reused, {} computed: {}\n", count_reported(sweep),
               number_of(report.rendered, "variant"), report.kept,
               number_of(report.solved, "heat balance"), options.out.string());
    print_notes(report.notes);
    if (report.missing > 0) {
        fmt::print(stderr,
                   "note: {} variants are not complete yet; the last shard to finish writes "
                   "annotations.json and manifest.json for all variants\n",
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
    throw InputError("--only", fmt::format("unknown variant '{}', expected {} to {}, or base", name,
                                           names.front(), names.back()));
}

void run_one(Scene scene, const JobOptions& job) {
    const JobReport report = run_job(std::move(scene), job);
    double seconds = 0.0;
    for (const auto& stage : report.stages) seconds += stage.seconds;
    fmt::print("{}, {}, {} rendered, {}, {:.1f} s: {}\n", number_of(report.plan.facets, "facet"),
               picture_counts(report.plan), number_of(report.frames_rendered, "view"),
               number_of(report.files.size(), "file"), seconds, (job.out / "report.html").string());
    // Files of the folder, then approximations and their size, then what to check.
    if (!report.resumed.empty()) print_notes({report.resumed});
    print_notes(report.remade);
    if (!report.start.empty()) fmt::print(stderr, "note: start: {}\n", plain(report.start));
    print_notes(report.notes);
    print_warnings(report.warnings);
    // Results that have not converged are kept, but the program fails.
    if (!report.not_converged.empty()) throw std::runtime_error(report.not_converged);
}

/// Takes out of --only what names a variant: "" where nothing does.
std::string take_variant(std::vector<std::string>& only) {
    const auto named = std::find_if(only.begin(), only.end(), [](const std::string& text) {
        return text.find('=') == std::string::npos;
    });
    if (named == only.end()) return "";
    std::string variant = std::move(*named);
    only.erase(named);
    return variant;
}

void set_job(const SceneArguments& a, JobOptions& job) {
    job.settings = a.settings;
    job.progress = a.style();
    job.stages = a.stages();
    job.max_memory = a.memory();
    job.scene_with = reads_scene(a.scene, a.settings, a.allow_outside);
}

void run_verb(const SceneArguments& a, RunArguments run) {
    Scene scene = a.read();
    JobOptions& job = run.job;
    set_job(a, job);
    if (!run.shard.empty()) job.pictures.shard = read_shard(run.shard);
    const std::string variant = take_variant(*run.only);
    job.pictures.only = *run.only;
    if (scene.sweep.axes.empty()) {
        if (!variant.empty()) {
            throw InputError("--only", fmt::format("found '{}', but the scene has no [sweep]; "
                                                   "expected observer=, band= or frames=",
                                                   variant));
        }
    } else if (variant != "base") {
        const Sweep sweep = read_sweep_variants(a.scene, a.settings, a.allow_outside);
        if (variant.empty()) {
            if (job.pictures.shard.number == 0 || !job.from.empty()) {
                throw InputError(job.from.empty() ? "--shard" : "--from",
                                 "not available for a scene with [sweep]",
                                 "its variants share temperatures in one folder");
            }
            if (!run.only->empty()) {
                throw InputError(
                    "--only",
                    fmt::format("found '{}' without a variant, but the scene has a [sweep]",
                                run.only->front()),
                    "name a variant as well: --only v0");
            }
            run_sweep_verb(sweep, run, a.style());
            return;
        }
        scene = only_variant(sweep, variant, job);
        job.scene_with = nullptr;
    }
    run_one(std::move(scene), job);
}

void render_verb(SceneArguments a, JobOptions job, const std::vector<std::string>& only) {
    take_rounds(job.temperatures, a.settings);
    Scene scene = a.read();
    set_job(a, job);
    job.pictures.only = only;
    tell_of_sweep(scene);
    run_one(std::move(scene), job);
}

void merge_verb(const SceneArguments& a, JobOptions job) {
    Scene scene = a.read();
    set_job(a, job);
    if (!scene.sweep.axes.empty()) {
        throw InputError("merge", "the scene has a [sweep]; its shards write to one folder",
                         "no merge is needed: the last shard to finish writes the common files");
    }
    run_one(std::move(scene), job);
}

}  // namespace

void add_run_verb(CLI::App& app) {
    CLI::App* verb =
        app.add_subcommand("run", "compute everything: temperatures, pictures, labels, report");
    const auto a = solving_arguments(*verb);
    const auto run = std::make_shared<RunArguments>();
    verb->add_option("--out", run->job.out, "folder for the results (default: out)");
    verb->add_flag("--resume", run->job.resume,
                   "reuse the results of an earlier run with the same inputs");
    add_checks(*verb, a);
    verb->add_option("--shard", run->shard,
                     "I/N: compute part I of N of the pictures (or of a sweep's variants); 0/N: "
                     "temperatures only");
    verb->add_option("--from", run->job.from,
                     "reuse the results in this folder, made by a run with the same inputs");
    add_choice(*verb, run->only,
               "; in a sweep: the name of a variant, or base for the scene without its sweep");
    verb->callback([a, run] { run_verb(*a, *run); });
}

void add_render_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand(
        "render", "pictures, labels and report from the temperatures of an earlier solve or run");
    const auto a = solving_arguments(*verb);
    const auto job = std::make_shared<JobOptions>();
    const auto only = std::make_shared<std::vector<std::string>>();
    verb->add_option("--temperatures", job->temperatures,
                     "netCDF file of temperatures, written by solve or run")
        ->required();
    verb->add_option("--out", job->out, "folder for the results (default: out)");
    verb->add_flag("--resume", job->resume,
                   "reuse the results of an earlier render with the same inputs");
    add_choice(*verb, only);
    verb->callback([=] { render_verb(*a, *job, *only); });
}

void add_merge_verb(CLI::App& app) {
    CLI::App* verb =
        app.add_subcommand("merge", "join the folders of a run's shards, after checking them");
    const auto a = solving_arguments(*verb);
    const auto job = std::make_shared<JobOptions>();
    verb->add_option("FOLDERS", job->parts, "folders written by run --shard")->required();
    verb->add_option("--out", job->out, "folder for the joined results")->required();
    verb->callback([a, job] { merge_verb(*a, *job); });
}

}  // namespace diurna
