#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "scenes/plan/plan.hpp"
#include "scenes/plan/progress.hpp"
#include "terrain/ground/triangulate.hpp"
#include "thermal/solve/solver.hpp"

namespace diurna {

/// A file that the results depend on (scenes/cache/inputs.hpp).
struct JobInput {
    std::string name, sha256;
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
    std::vector<std::string> remade{};  // what of earlier runs was not kept, and what was taken
                                        // from their store, a line each
    std::vector<std::string> notes{};   // what was modelled for want of data
    std::vector<JobInput> inputs{};
    std::vector<std::string> settings{};  // of the command line
    std::vector<std::string> warnings{};  // what is implausible (scenes/warnings)
};

}  // namespace diurna
