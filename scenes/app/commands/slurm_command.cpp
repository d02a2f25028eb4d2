#include "scenes/app/commands/slurm_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/app/commands/number_option.hpp"
#include "scenes/app/commands/scene_arguments.hpp"
#include "scenes/app/sweep/checked_folder.hpp"
#include "scenes/app/sweep/variants.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/job/run/slurm_scripts.hpp"
#include "scenes/job/store/inputs.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;

/// What the plan's bytes are taken times: of ten scenes it missed four by more than 1.2.
constexpr double spare = 1.5, program_itself = 256e6;

struct SlurmArguments {
    fs::path out, scripts;
    SlurmJob job;
};

void slurm_verb(const SceneArguments& a, SlurmArguments s) {
    SlurmJob& job = s.job;
    Scene scene = a.read();
    job.sweep = !scene.sweep.axes.empty();
    if (job.sweep) {
        check_sweep_folder(s.out, paths_of(named_inputs(scene)), false);
    } else {
        check_job_folder(scene, {.out = s.out, .settings = a.settings});
    }
    job.work = fs::absolute(s.scripts).lexically_normal();
    if (const std::string why = why_no_output_folder(job.work); !why.empty()) {
        throw InputError("--scripts", job.work.string() + " " + why);
    }
    if (fs::exists(job.work) && !fs::is_empty(job.work)) {
        throw InputError("--scripts", job.work.string() + " exists and is not empty",
                         "expected a new folder for scripts, logs and shards");
    }
    std::size_t things = 0;
    if (job.sweep)
        things = read_sweep_variants(a.scene, a.settings, a.allow_outside).variants.size();
    const Prepared prepared = prepare(std::move(scene));
    if (!job.sweep) things = prepared.plan.views;
    if (job.shards > things) {
        throw InputError("--shards",
                         fmt::format("found {}, expected at most {}, the number of {}", job.shards,
                                     things, job.sweep ? "variants" : "pictures"));
    }
    job.program = fs::read_symlink("/proc/self/exe");
    job.scene = fs::absolute(a.scene).lexically_normal();
    job.out = fs::absolute(s.out).lexically_normal();
    job.name = prepared.scene.name;
    job.settings = a.settings;
    job.allow_outside = a.allow_outside;
    job.memory = spare * prepared.plan.memory + program_itself;
    const auto scripts = slurm_scripts(job);
    fs::create_directories(job.work);
    for (const auto& [name, text] : scripts) write_whole_file(job.work / name, text);
    fs::permissions(job.work / "submit.sh", fs::perms::owner_exec, fs::perm_options::add);
    fmt::print("{} {} in {} shards of {} processors and {:.1f} GB each: {}\n", things,
               job.sweep ? "variants" : "pictures", job.shards, job.cpus, 1e-9 * job.memory,
               (job.work / "submit.sh").string());
}

}  // namespace

void add_slurm_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand(
        "slurm", "write Slurm scripts that split a run between the nodes of a cluster");
    const auto a = scene_arguments(*verb);
    const auto s = std::make_shared<SlurmArguments>();
    verb->add_option("--out", s->out,
                     "folder for the results, on a file system that all nodes share")
        ->required();
    verb->add_option("--scripts", s->scripts,
                     "new folder for scripts, logs and shards, on a shared file system")
        ->required();
    whole_within(verb->add_option("--shards", s->job.shards,
                                  "number of tasks that share the pictures or variants"),
                 1, 100000)
        ->required();
    whole_within(verb->add_option("--cpus", s->job.cpus, "processors per task (default: 4)"), 1,
                 1024);
    verb->add_option("--sbatch", s->job.directives,
                     "an additional directive of every job: --sbatch=--partition=long");
    verb->callback([a, s] { slurm_verb(*a, *s); });
}

}  // namespace diurna
