#pragma once

#include <array>
#include <string>
#include <vector>

#include "render/detection/tasks.hpp"
#include "scenes/job/input/read_detection.hpp"
#include "scenes/job/run/picture_shares.hpp"
#include "scenes/studies/signature_scene.hpp"

namespace diurna {

/// A target in an instrument's band at an instant, rendered from its observer's position.
struct SeenTarget {
    Instant when;
    double range = 0.0;          // [m] from the eye to its middle
    double elevation_deg = 0.0;  // of the eye above its level
    double area = 0.0;           // [m²] visible, projected
    double least_width = 0.0;    // [m] of the upright box around it in the picture
    double difference = 0.0;     // [K] of apparent temperature: mean minus the background's
    double background = 0.0;     // [K] that mean
    double spread = 0.0;         // [K] standard deviation over the target
    double contrast = 0.0;       // [K] root sum square of that and of its spread
    double transmittance = 0.0;  // of the air to it, weighted by Planck's slope at 300 K
};

/// Probabilities over range at an instant.
struct DetectionCurve {
    SeenTarget target;
    std::vector<double> range;                           // [m]
    std::vector<double> transmittance;                   // (range)
    std::vector<double> contrast;                        // (range) [K] at the eye
    std::array<std::vector<double>, 3> johnson, metric;  // (task)(range) probabilities
    /// (task)(probability): ranges [m]; 0: not even at the shortest range.
    std::array<std::vector<double>, 3> johnson_range, metric_range;
};

/// The pictures that it makes, with one ray a pixel, to find what they show.
std::vector<SeenView> detection_views(const Stages& stages,
                                      const std::vector<DetectionInput>& inputs);

/// The contrast is that of the picture converted to other ranges on the same line
/// (scenes/studies/contrast_on_line.hpp). Aspect and background are unchanged. Throws InputError
/// for a target that is not visible.
std::vector<DetectionCurve> detection_of(const Stages& stages, const DetectionInput& input,
                                         const TemperatureField& field, Progress& progress);

/// Assumptions, and the instrument's values in the formulas, a line each.
std::vector<std::string> detection_notes(const Scene& scene, const DetectionInput& input);

}  // namespace diurna
