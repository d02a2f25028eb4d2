#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "render/detection/imager.hpp"
#include "scenes/job/input/read_instrument.hpp"
#include "scenes/job/input/read_signature.hpp"

namespace diurna {

/// [[detection]]: ranges at which an observer of an instrument's display detects an object.
struct DetectionInput {
    std::string name;
    StudiedObject studied;
    std::size_t instrument = 0;                   // of the scene's
    std::array<double, 2> range{100.0, 30000.0};  // [m]
    std::vector<double> probabilities{0.5, 0.9};  // for which ranges are reported
    bool across = false;          // Johnson's cycles over the smallest dimension, not √area
    std::array<double, 3> v50{};  // of detection, recognition, identification
    std::array<double, 3> n50{};
    Viewing viewing;
};

std::vector<DetectionInput> read_detections(const Section& root, const TerrainInput& terrain,
                                            const std::vector<InstrumentInput>& instruments,
                                            const std::vector<BandInput>& bands,
                                            const std::vector<ObserverInput>& observers,
                                            const TimeInput& time, const std::optional<Site>& site);

}  // namespace diurna
