#include "scenes/job/run/slurm_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// As one word of a shell.
std::string word(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) {
        if (c == '\'')
            quoted += "'\\''";
        else
            quoted += c;
    }
    return quoted + "'";
}

/// As a value of an #SBATCH line, which no shell reads: % begins a pattern there.
std::string value(const std::string& text) {
    const bool plain = std::none_of(text.begin(), text.end(), [](unsigned char c) {
        return c < ' ' || c == '"' || c == '%' || c == '\\' || c == 0x7f;
    });
    if (!plain) {
        throw InputError("slurm", fmt::format("#SBATCH lines cannot contain '{}'", text),
                         "expected no \", %, \\ or control characters");
    }
    return '"' + text + '"';
}

std::string head(const SlurmJob& job, const std::string& part, const std::string& log) {
    std::string text = fmt::format(
        "#!/bin/bash\n#SBATCH --job-name={}\n#SBATCH --output={}\n#SBATCH --open-mode=append\n"
        "#SBATCH --requeue\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task={}\n#SBATCH "
        "--mem={:.0f}M\n",
        value(job.name + "-" + part), value((job.work / log).string()), job.cpus,
        std::ceil(job.memory / 1048576.0));
    for (const std::string& directive : job.directives) {
        value(directive);
        text += "#SBATCH " + directive + "\n";
    }
    return text +
           "set -euo pipefail\nexport DIURNA_STAGES=" + word((job.work / "stages").string()) + "\n";
}

/// The program with a verb, the scene and what all of its verbs are reported alike.
std::string call(const SlurmJob& job, const std::string& verb) {
    std::string text =
        fmt::format("{} {} {}", word(job.program.string()), verb, word(job.scene.string()));
    for (const std::string& setting : job.settings) text += " --set " + word(setting);
    if (job.allow_outside) text += " --allow-outside";
    return text + " --threads \"${SLURM_CPUS_PER_TASK:-0}\"";
}

std::string run(const SlurmJob& job, const std::string& shard, const std::string& out) {
    return fmt::format("{} --resume --shard {}/{} --out {}", call(job, "run"), shard, job.shards,
                       out);
}

std::string submit(const SlurmJob& job) {
    const std::string here = "cd " + word(job.work.string()) + "\n";
    const std::string array = fmt::format("--array=1-{} shard.sbatch", job.shards);
    std::string text =
        "#!/bin/bash\n# Submits all jobs to Slurm and prints the number of the last job.\nset -euo "
        "pipefail\n" +
        here;
    if (job.sweep) return text + "sbatch --parsable " + array + "\n";
    return text + "heat=$(sbatch --parsable heat.sbatch)\n" +
           "shards=$(sbatch --parsable --kill-on-invalid-dep=yes "
           "--dependency=\"afterok:${heat%%;*}\" " +
           array + ")\n" +
           "sbatch --parsable --kill-on-invalid-dep=yes --dependency=\"afterok:${shards%%;*}\" "
           "join.sbatch\n";
}

}  // namespace

std::map<std::string, std::string> slurm_scripts(const SlurmJob& job) {
    const std::string task = "\"$SLURM_ARRAY_TASK_ID\"";
    std::map<std::string, std::string> scripts{{"submit.sh", submit(job)}};
    std::string& shard = scripts["shard.sbatch"];
    // %a, the task, is not of a path: it stands behind what value() has looked at.
    shard = head(job, "shard", "shard.log");
    const std::string log = (job.work / "shard.log").string();
    shard.replace(shard.find(log), log.size(), (job.work / "shard-%a.log").string());
    if (job.sweep) {
        shard += run(job, task, word(job.out.string())) + "\n";
        return scripts;
    }
    const std::string heat = word((job.work / "part-0").string());
    const std::string part = word((job.work / "part-").string());
    scripts["heat.sbatch"] = head(job, "heat", "heat.log") + run(job, "0", heat) + "\n";
    shard += run(job, task, part + task) + " --from " + heat + "\n";
    scripts["join.sbatch"] =
        head(job, "join", "join.log") +
        fmt::format(
            "parts=()\nfor i in $(seq {}); do parts+=({}\"$i\"); done\n{} \"${{parts[@]}}\" "
            "--out {}\n",
            job.shards, part, call(job, "merge"), word(job.out.string()));
    return scripts;
}

}  // namespace diurna
