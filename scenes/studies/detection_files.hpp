#pragma once

#include <string>
#include <vector>

#include "scenes/studies/detection.hpp"

namespace diurna {

/// Probabilities over range as CSV, its header first.
///
/// - utc_offset: [s] of the scene's clock
std::string detection_csv(const std::vector<DetectionCurve>& curves, double utc_offset);

/// Settings and constants with their sources, the target's values and, by instant, the ranges of
/// the requested probabilities.
std::string detection_json(const DetectionInput& input, const std::string& instrument,
                           const std::vector<DetectionCurve>& curves,
                           const std::vector<std::string>& notes, double utc_offset);

/// Probabilities over range: a chart for each instant, the metric's lines solid, Johnson's dashed.
/// For several instants, followed by one of the ranges of the first probability over time.
std::string detection_svg(const DetectionInput& input, const std::vector<DetectionCurve>& curves,
                          double utc_offset);

}  // namespace diurna
