#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/job/input/read_sensitivity.hpp"
#include "scenes/studies/elementary_effects.hpp"
#include "scenes/studies/other_scene.hpp"

namespace diurna {

/// An output with one number at each end of its range, all others as in the scene; NaN if
/// undefined: no crossover, or one more than three hours away.
struct OneAtATime {
    double low = 0.0, high = 0.0;  // [K], [h]
    double slope = 0.0;            // (high - low) per unit of the number
};

/// Effect of the uncertain numbers on one output.
struct OutputSensitivity {
    double base = 0.0;                     // [K], [h] of the unchanged scene; NaN if undefined
    std::vector<OneAtATime> alone;         // (uncertain)
    std::vector<ElementaryEffect> effect;  // (uncertain); empty without Morris's screening
    /// To first order, for independent numbers uniformly distributed over their ranges: root sum
    /// square of (high - low) / √12. NaN if one of them is.
    double deviation = 0.0;
};

/// Scenes of the screening whose temperatures are combined (scenes/studies/combined_heat.hpp), and
/// the error where one of them was solved.
struct CombinedScenes {
    std::size_t scenes = 0;               // that were not solved
    std::vector<std::string> settings{};  // of the one that was; empty: none was tried
    double rms = 0.0, worst = 0.0;        // [K] of its temperatures, over facets and steps
    std::vector<double> output{};         // (output) [K], [h] combined minus solved; NaN: undefined
};

struct SensitivityReport {
    std::vector<OutputSensitivity> output;
    std::size_t scenes = 0;  // evaluated in addition to the study's own
    std::size_t solved = 0;  // heat balances, also in the middle of ranges
    std::size_t shared = 0;  // of these, with the temperatures of the unchanged scene
    CombinedScenes combined{};
    std::vector<std::string> notes{};  // without convergence, effect, or crossover
    bool converged = true;             // the heat balances of those scenes converged
};

/// Throws InputError if something moves, a region fills no pixel or has no facet, or values to be
/// tried are invalid: before anything is solved.
void check_sensitivity(const Prepared& prepared, const SensitivityInput& input,
                       const SceneWith& scene_with);

/// - field: temperatures of the unchanged scene, stored at every step
SensitivityReport sensitivity_of(Study& study, const SensitivityInput& input,
                                 const TemperatureField& field, const SceneWith& scene_with);

}  // namespace diurna
