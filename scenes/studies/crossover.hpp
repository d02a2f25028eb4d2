#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scenes/input/read_crossover.hpp"
#include "scenes/studies/crossings.hpp"
#include "scenes/studies/other_scene.hpp"

namespace diurna {

/// A crossing, and how well its hour is known.
struct TimedCrossing {
    Instant when;  // to the second; where it was refined, of the finer solution
    ZeroCrossing::Kind kind = ZeroCrossing::Kind::crosses;
    bool first_warmer_after = false;
    double slope = 0.0;  // [K/s] of the difference, first less second; [K] of what jumps: its step
    double least = 0.0;  // [K] of what touches
    /// [s] by which it has moved with half the step and twice the samples: of second order, three
    /// times what is left; none: not tried, or it is gone then.
    std::optional<double> refined;
    /// (uncertain number) [s] by which it moves a standard deviation away; none: it is gone, or
    /// more than three hours off.
    std::vector<std::optional<double>> shift;
    double sigma = 0.0;  // [s] root sum square of all shifts that there are
};

/// Two regions in one band over the span.
struct CrossoverDay {
    std::string band;
    std::vector<Instant> instant;
    std::vector<double> first, second;  // (instant) [K] apparent temperature, mean over pixels
    std::vector<TimedCrossing> crossing;
    double lost = 0.0;         // [s] with less contrast than the threshold
    double worst_least = 0.0;  // [K] the least contrast of all instants
};

struct CrossoverReport {
    std::vector<CrossoverDay> band;
    std::size_t first_pixels = 0, second_pixels = 0;
};

struct CrossoverAnswer {
    std::vector<CrossoverReport> report;  // (crossover of the scene)
    std::vector<std::string> notes;       // of the scenes that were solved beside it
};

/// All crossovers of a scene: those that are asked of one observer share its pictures. Throws
/// InputError for regions that fill no pixel, and where an object or the observer goes.
CrossoverAnswer crossovers_of(Study& study, const TemperatureField& field,
                              const SceneWith& scene_with);

/// Throws InputError where one of them cannot be, a region fills no pixel, or an uncertain number
/// is none of the scene's: before anything is solved.
void check_crossovers(const Study& study, const SceneWith& scene_with);

}  // namespace diurna
