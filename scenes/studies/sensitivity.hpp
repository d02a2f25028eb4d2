#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/input/read_sensitivity.hpp"
#include "scenes/studies/elementary_effects.hpp"
#include "scenes/studies/other_scene.hpp"

namespace diurna {

/// An output with one number at either end of its range, all others as the scene has them; NaN
/// where there is none: a crossover that is gone, or more than three hours off.
struct OneAtATime {
    double low = 0.0, high = 0.0;  // [K], [h]
    double slope = 0.0;            // (high - low) for each unit of the number
};

/// What the uncertain numbers do to one output.
struct OutputSensitivity {
    double base = 0.0;              // [K], [h] of the scene as it is; NaN where there is none
    std::vector<OneAtATime> alone;  // (uncertain)
    std::vector<ElementaryEffect> effect;  // (uncertain); empty without Morris's screening
    /// To first order, of numbers that are independent and as likely anywhere in their ranges: root
    /// sum square of (high - low) / √12. NaN where one of them is.
    double deviation = 0.0;
};

struct SensitivityReport {
    std::vector<OutputSensitivity> output;
    std::size_t scenes = 0;            // that were solved beside the study's own
    std::vector<std::string> notes{};  // what has not converged, changes nothing, or is gone
    bool converged = true;             // the heat balances of those scenes have
};

/// Throws InputError where something goes, a region fills no pixel or has no facet, or numbers that
/// will be tried cannot be: before anything is solved.
void check_sensitivity(const Study& study, const SensitivityInput& input,
                       const SceneWith& scene_with);

/// - field: temperatures of the scene as it is, kept at every step
SensitivityReport sensitivity_of(Study& study, const SensitivityInput& input,
                                 const TemperatureField& field, const SceneWith& scene_with);

}  // namespace diurna
