#include "scenes/commands/run_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/plain_text.hpp"
#include "scenes/commands/printed_lines.hpp"
#include "scenes/commands/scene_arguments.hpp"
#include "scenes/run/job.hpp"
#include "scenes/sweep/run_sweep.hpp"
#include "scenes/sweep/sweep_plan.hpp"
#include "scenes/sweep/variants.hpp"

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
    fmt::print("{}: {} variants rendered, {} kept, {} heats solved: {}\n", count_reported(sweep),
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

void run_one(Scene scene, const JobOptions& job) {
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
            throw InputError("--only", fmt::format("found '{}' where the scene has no [sweep], "
                                                   "expected observer=, band= or frames=",
                                                   variant));
        }
    } else if (variant != "base") {
        const Sweep sweep = read_sweep_variants(a.scene, a.settings, a.allow_outside);
        if (variant.empty()) {
            if (job.pictures.shard.number == 0 || !job.from.empty()) {
                throw InputError(job.from.empty() ? "--shard" : "--from",
                                 "found where the scene has a [sweep]",
                                 "its variants share temperatures in one folder");
            }
            if (!run.only->empty()) {
                throw InputError("--only", fmt::format("found '{}' of a sweep", run.only->front()),
                                 "name a variant, too: --only v0");
            }
            run_sweep_verb(sweep, run, a.style());
            return;
        }
        scene = only_variant(sweep, variant, job);
    }
    run_one(std::move(scene), job);
}

void render_verb(const SceneArguments& a, JobOptions job, const std::vector<std::string>& only) {
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
        throw InputError("merge", "the scene has a [sweep], whose shards share one folder",
                         "the shard that ends last writes what is of all");
    }
    run_one(std::move(scene), job);
}

}  // namespace

void add_run_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand("run", "the whole job: temperatures, frames, report");
    const auto a = solving_arguments(*verb);
    const auto run = std::make_shared<RunArguments>();
    verb->add_option("--out", run->job.out, "folder for the results (default: out)");
    verb->add_flag("--resume", run->job.resume, "keep what an earlier run of the same inputs left");
    verb->add_option("--shard", run->shard,
                     "I/N: this part of the pictures, or of a sweep's variants; 0/N: of the "
                     "pictures none, temperatures alone");
    verb->add_option("--from", run->job.from,
                     "folder of a run of the same inputs: what it has left is taken");
    add_choice(*verb, run->only,
               "; of a sweep a variant's name makes a run of it by itself, base of the scene as it "
               "stands");
    verb->callback([a, run] { run_verb(*a, *run); });
}

void add_render_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand(
        "render", "what run does with temperatures that are there: frames, labels, report");
    const auto a = solving_arguments(*verb);
    const auto job = std::make_shared<JobOptions>();
    const auto only = std::make_shared<std::vector<std::string>>();
    verb->add_option("--temperatures", job->temperatures, "netCDF file of `solve` or `run`")
        ->required();
    verb->add_option("--out", job->out, "folder for the results (default: out)");
    verb->add_flag("--resume", job->resume, "keep what an earlier render of the same has left");
    add_choice(*verb, only);
    verb->callback([=] { render_verb(*a, *job, *only); });
}

void add_merge_verb(CLI::App& app) {
    CLI::App* verb =
        app.add_subcommand("merge", "one run's folder of those of its shards, checked and joined");
    const auto a = solving_arguments(*verb);
    const auto job = std::make_shared<JobOptions>();
    verb->add_option("FOLDERS", job->parts, "of run --shard")->required();
    verb->add_option("--out", job->out, "folder for the whole")->required();
    verb->callback([a, job] { merge_verb(*a, *job); });
}

}  // namespace diurna
