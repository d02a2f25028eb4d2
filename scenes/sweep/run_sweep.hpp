#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/plan/progress.hpp"
#include "scenes/plan/shard.hpp"
#include "scenes/sweep/variants.hpp"

namespace diurna {

struct SweepOptions {
    std::filesystem::path out = "out";
    bool resume = false;  // keep what an earlier run of the same inputs has left
    Shard shard{};
    double max_memory = 0.0;  // [bytes] as JobOptions has it
    ProgressTo progress{};
};

struct SweepReport {
    std::size_t rendered = 0, kept = 0;  // variants of this shard
    std::size_t solved = 0;              // heats
    std::size_t missing = 0;             // variants of other shards that are not there yet
    std::vector<std::string> notes{};
    std::vector<std::string> not_converged{};
};

/// Runs the variants of a shard one after the other into a folder:
///
///     heat/HEAT/temperatures.nc      of all variants that differ in their pictures alone
///     variants/VARIANT/...           pictures and labels as of a run of that scene by itself
///     annotations.json, ...          of all variants (merged_labels.hpp)
///     manifest.json                  of all variants (records.hpp)
///
/// The last two once all variants are there, whichever shard ends last. The same bytes for any
/// division and number of threads.
SweepReport run_sweep(const Sweep& sweep, const SweepOptions& options);

}  // namespace diurna
