#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/job/input/read_contrast.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/run/stages.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// A target in a band of a picture. NaN for undefined values.
struct ContrastRow {
    std::size_t target = 0, observer = 0;  // of the input's
    Instant when;
    std::string band;
    double range = 0.0;   // [m] to its nearest pixel's surface
    double pixels = 0.0;  // covered pixels, edges by their share
    double height = 0.0;  // [m] above the sea of its visible surface, mean
    // Of apparent temperature [K]:
    double difference = 0.0;                         // mean minus the background's
    double spread = 0.0;                             // standard deviation over fully covered pixels
    double background = 0.0;                         // the background's mean
    double rss = 0.0;                                // √(difference² + spread²)
    double clutter = 0.0;                            // (render/detection/busy_background.hpp)
    int clutter_side = 0;                            // [pixels] of its square cells
    double signal_to_clutter = 0.0;                  // |difference| / clutter
    double edge = 0.0;                               // [K/pixel] mean gradient at its border,
    double background_edge = 0.0;                    // and in the background
    double similarity = 0.0;                         // 0 to 1: how similar cells of its size are
    double entropy = 0.0, background_entropy = 0.0;  // [bits] in steps of 0.1 K
    double radiance = 0.0;  // [W m⁻² sr⁻¹] mean minus the background's
    double weber = 0.0;     // that divided by the background's
};

/// A target in a band from one observer, over all its pictures. Rows are the report's; its number
/// of rows where the target is visible in no picture.
struct ContrastSummary {
    std::size_t target = 0, band = 0, observer = 0;  // of the input's
    std::size_t highest = 0, lowest = 0;             // rows with the largest and the smallest rss
    double sampling_change = 0.0;  // [K] change of the highest rss with half the samples
    double share = 0.0;            // of the pictures with rss above the threshold
    std::vector<double> at_range;  // (range) [K] highest rss at that range; NaN behind the target
};

struct ContrastReport {
    std::vector<ContrastRow> row;          // by target, observer, instant, band
    std::vector<ContrastSummary> summary;  // by target, band, observer
    std::size_t hidden = 0;                // rows in which the target is not visible
};

/// Contrast in the pictures of a scene's observers against the pixels of the box around the target,
/// widened by the ring on each side, including everything visible there except other targets of the
/// list. Throws InputError if something moves at a picture's instant.
ContrastReport contrast_of(const Stages& stages, const ContrastInput& input,
                           const TemperatureField& field, Progress& progress);

}  // namespace diurna
