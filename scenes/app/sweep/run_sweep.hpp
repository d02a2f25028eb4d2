#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/app/sweep/variants.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/plan/shard.hpp"

namespace diurna {

struct SweepOptions {
    std::filesystem::path out = "out";
    bool resume = false;  // retain results of an earlier run of the same inputs
    Shard shard{};
    double max_memory = 0.0;  // [bytes] as in JobOptions
    ProgressTo progress{};
};

struct SweepReport {
    std::size_t rendered = 0, kept = 0;  // variants of this shard
    std::size_t solved = 0;              // heats
    std::size_t missing = 0;             // variants of other shards that do not exist yet
    std::vector<std::string> notes{};
    std::vector<std::string> not_converged{};
};

/// Runs the variants of a shard one after the other into a folder:
///
///     heat/HEAT/temperatures.nc      common to variants that differ only in their pictures
///     variants/VARIANT/...           pictures and labels as in a separate run of that scene
///     annotations.json, ...          of all variants (merged_labels.hpp)
///     manifest.json                  of all variants (records.hpp)
///
/// The last two are written when all variants are complete, by the last shard. The same bytes for
/// any division and number of threads.
SweepReport run_sweep(const Sweep& sweep, const SweepOptions& options);

}  // namespace diurna
