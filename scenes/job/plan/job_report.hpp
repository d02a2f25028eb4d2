#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "scenes/job/plan/plan.hpp"
#include "scenes/job/plan/progress.hpp"
#include "terrain/ground/triangulate.hpp"
#include "thermal/solve/solver.hpp"

namespace diurna {

/// A file that the results depend on (scenes/job/store/inputs.hpp).
struct JobInput {
    std::string name, sha256;
};

/// Result of a run, for the report and for tests.
struct JobReport {
    Plan plan{};
    TinCheck ground_check{};
    std::size_t posts = 0;
    SolveReport solve{};  // of this run's heat balance
    bool solved = false;  // false: temperatures are from an earlier run
    std::vector<std::pair<std::string, std::string>> heat{};  // HeatReport::rows of the solution
    std::string start{};               // how the heat balance's start was computed, and its effect
    std::string not_converged{};       // in one line, of this or the earlier run; "" if converged
    std::size_t frames_rendered = 0;   // the others are from an earlier run
    std::vector<std::string> files{};  // written or retained, relative to the folder
    std::vector<Progress::Stage> stages{};
    std::string resumed{};              // with --resume: what was reused, in one line
    std::vector<std::string> remade{};  // files regenerated and results from the cache,
                                        // one line each
    std::vector<std::string> notes{};   // quantities modelled for lack of data
    std::vector<JobInput> inputs{};
    std::vector<std::string> settings{};  // of the command line
    std::vector<std::string> warnings{};  // implausible input (scenes/job/warnings)
};

}  // namespace diurna
