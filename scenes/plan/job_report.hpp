#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "scenes/plan/plan.hpp"
#include "scenes/plan/progress.hpp"
#include "terrain/ground/triangulate.hpp"
#include "thermal/solve/solver.hpp"

namespace diurna {

struct JobOptions {
    std::filesystem::path out = "out";
    std::vector<std::string> settings;  // "key=value" given on the command line
    bool resume = false;                // keep what an earlier run with the same inputs has left
    ProgressStyle progress = ProgressStyle::silent;
};

/// What a run did, for the report and for tests.
struct JobReport {
    Plan plan{};
    TinCheck ground_check{};
    std::size_t posts = 0;
    SolveReport solve{};  // of this run's heat balance
    bool solved = false;  // false: temperatures were kept from an earlier run
    std::vector<std::pair<std::string, std::string>> heat{};  // heat_rows(), kept or of this run
    std::string start{};               // how the heat balance's was found, and what it is worth
    std::string not_converged{};       // in one line, of this or the earlier run; "" where it has
    std::size_t frames_rendered = 0;   // the others were kept
    std::vector<std::string> files{};  // written or kept, relative to the folder
    std::vector<Progress::Stage> stages{};
    std::vector<std::string> remade{};    // what of earlier runs was not kept, a line each
    std::vector<std::string> notes{};     // what was modelled for want of data
    std::vector<std::string> warnings{};  // what is hardly meant (scenes/doubts)
};

}  // namespace diurna
