#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace diurna {

/// A job to be distributed over the nodes of a cluster with a shared file system.
struct SlurmJob {
    std::filesystem::path program, scene, out;  // absolute
    std::filesystem::path work;                 // folder of scripts, their logs and the shards
    std::string name;                           // as the queue shows it
    std::vector<std::string> settings{};        // of --set
    bool allow_outside = false;
    bool sweep = false;  // shards share `out` and merge themselves
    std::size_t shards = 2;
    int cpus = 4;                           // of a shard
    double memory = 0.0;                    // [bytes] of a shard
    std::vector<std::string> directives{};  // of sbatch, for all: "--partition=long"
};

/// The scripts by name: submit.sh submits the others to sbatch. `heat` solves, then the array
/// `shard` renders the pictures, each task separately, and restarted after a node's failure
/// (--requeue, --resume), then `join` merges; for a sweep only the array. All words of the job are
/// quoted for the shell. Throws InputError for one that #SBATCH lines cannot express.
std::map<std::string, std::string> slurm_scripts(const SlurmJob& job);

}  // namespace diurna
