#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scenes/job/input/read_crossover.hpp"
#include "scenes/studies/crossings.hpp"
#include "scenes/studies/other_scene.hpp"

namespace diurna {

/// A crossing, and the accuracy of its time.
struct TimedCrossing {
    Instant when;  // to the second; if refined, from the finer solution
    ZeroCrossing::Kind kind = ZeroCrossing::Kind::crosses;
    bool first_warmer_after = false;
    double slope = 0.0;  // [K/s] of the difference, first minus second; [K] step of a jump
    double least = 0.0;  // [K] minimum of a touch
    /// [s] change with half the step and twice the samples: of second order, three times the
    /// remaining error; none: not computed, or no crossing then.
    std::optional<double> refined;
    /// (uncertain number) [s] change for one standard deviation; none: no crossing, or more than
    /// three hours away.
    std::vector<std::optional<double>> shift;
    double sigma = 0.0;  // [s] root sum square of all available changes
};

/// Two regions in one band over the span.
struct CrossoverDay {
    std::string band;
    std::vector<Instant> instant;
    std::vector<double> first, second;  // (instant) [K] apparent temperature, mean over pixels
    std::vector<TimedCrossing> crossing;
    double lost = 0.0;         // [s] with less contrast than the threshold
    double worst_least = 0.0;  // [K] the smallest contrast of all instants
    double nearest = 0.0;      // [K] the same with its sign, first minus second
    Instant nearest_at{};      // when, to the step of the heat balance
};

struct CrossoverReport {
    std::vector<CrossoverDay> band;
    std::size_t first_pixels = 0, second_pixels = 0;
};

struct CrossoverAnswer {
    std::vector<CrossoverReport> report;  // (crossover of the scene)
    std::vector<std::string> notes;       // of the additional scenes that were solved
};

/// All crossovers of a scene: those of one observer share its pictures. Throws InputError for
/// regions that fill no pixel, and if an object or the observer moves.
CrossoverAnswer crossovers_of(Study& study, const TemperatureField& field,
                              const SceneWith& scene_with);

/// Throws InputError if one of them is invalid, a region fills no pixel, or an uncertain number is
/// not in the scene: before anything is solved.
void check_crossovers(const Prepared& prepared, const SceneWith& scene_with);

}  // namespace diurna
