#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace diurna {

/// A job to be shared out among the nodes of a cluster that see the same files.
struct SlurmJob {
    std::filesystem::path program, scene, out;  // absolute
    std::filesystem::path work;                 // folder of scripts, their logs and the shards
    std::string name;                           // as the queue shows it
    std::vector<std::string> settings{};        // of --set
    bool allow_outside = false;
    bool sweep = false;  // shards share `out` and join themselves
    std::size_t shards = 2;
    int cpus = 4;                           // of a shard
    double memory = 0.0;                    // [bytes] of a shard
    std::vector<std::string> directives{};  // of sbatch, for all: "--partition=long"
};

/// The scripts by name: submit.sh hands the others to sbatch. `heat` solves, then the array
/// `shard` takes its pictures, each task by itself and anew after a node's end (--requeue,
/// --resume), then `join` merges; of a sweep the array alone. No word of the job is read by a shell
/// as anything but itself. Throws InputError for one that #SBATCH lines cannot say.
std::map<std::string, std::string> slurm_scripts(const SlurmJob& job);

}  // namespace diurna
