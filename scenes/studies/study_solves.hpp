#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/job/plan/plan.hpp"

namespace diurna {

/// Solutions of the heat balance that the studies of one kind take.
struct StudySolves {
    std::string kind;           // "crossover", as the command is called
    std::size_t tables = 0;     // of the scene
    std::size_t solves = 0;     // the scene's own included; fewer where numbers do not affect heat
    std::size_t scenes = 0;     // that are prepared
    double steps = 0.0;         // of all solves, in those of the scene's own
    double pictures = 0.0;      // of a band at an instant, at most
    double casts = 0.0;         // of the views of an observer
    bool with_pictures = true;  // false: they are of the study's own cameras, and not counted
    bool may_be_more = false;   // if combined temperatures turn out to be too inaccurate
};

/// Of every kind that the scene has tables of, without --temperatures.
std::vector<StudySolves> study_solves(const Scene& scene);

/// Lines for `diurna plan`: the number of solves of each command and the most time of its scenes,
/// heat balances and pictures; "" for a scene without studies.
std::string describe(const std::vector<StudySolves>& studies, const Plan& plan);

/// Solves of this kind; 0 if the scene has no such table.
std::size_t solves_of(const std::vector<StudySolves>& studies, const std::string& kind);

}  // namespace diurna
