#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/input/read_contrast.hpp"
#include "scenes/plan/progress.hpp"
#include "scenes/run/stages.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// A target in a band of a picture. NaN where there is nothing to take it of.
struct ContrastRow {
    std::size_t target = 0, observer = 0;  // of the input's
    Instant when;
    std::string band;
    double range = 0.0;   // [m] to its nearest pixel's surface
    double pixels = 0.0;  // that it covers, edges by their share
    double height = 0.0;  // [m] above the sea of what its pixels show, mean
    // Of apparent temperature [K]:
    double difference = 0.0;                         // mean less the background's
    double spread = 0.0;                             // standard deviation over pixels that it fills
    double background = 0.0;                         // the background's mean
    double rss = 0.0;                                // √(difference² + spread²)
    double clutter = 0.0;                            // (render/detection/busy_background.hpp)
    double signal_to_clutter = 0.0;                  // |difference| / clutter
    double edge = 0.0;                               // [K/pixel] mean gradient at its border,
    double background_edge = 0.0;                    // and in the background
    double similarity = 0.0;                         // 0 to 1: how like it cells of its size are
    double entropy = 0.0, background_entropy = 0.0;  // [bits] in steps of 0.1 K
    double radiance = 0.0;  // [W m⁻² sr⁻¹] mean less the background's
    double weber = 0.0;     // that over the background's
};

/// What a treatment is at its worst.
struct WorstContrast {
    std::size_t row = 0;           // of the report's, with the greatest rss
    double error = 0.0;            // [K] by which it moves with half the samples
    double share = 0.0;            // of the pictures in which rss is above the threshold
    double least = 0.0;            // [K] rss of its best picture
    std::vector<double> at_range;  // (range) [K] rss through the air there; NaN behind the target
};

struct ContrastReport {
    std::vector<ContrastRow> row;      // by target, observer, instant, band
    std::vector<WorstContrast> worst;  // (target · bands + band)
    std::size_t hidden = 0;            // rows in which nothing of a target is seen
};

/// Contrast in the pictures of a scene's observers against the pixels of the box around the target
/// that is wider by the ring on each side, whatever is seen there but other targets of the list.
/// Throws InputError where something is on its way at a picture's instant.
ContrastReport contrast_of(const Stages& stages, const ContrastInput& input,
                           const TemperatureField& field, Progress& progress);

}  // namespace diurna
