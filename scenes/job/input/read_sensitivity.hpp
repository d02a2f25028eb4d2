#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/input/read_observer.hpp"
#include "scenes/job/input/read_region.hpp"
#include "scenes/job/input/read_terrain.hpp"
#include "scenes/job/input/read_time.hpp"

namespace diurna {

/// A number of the scene with a range.
struct RangedInput {
    std::string key;               // its path in the scene file
    double low = 0.0, high = 0.0;  // low < high
    std::string where;             // in the scene file
};

/// A result of a scene to be examined.
struct SensitivityOutput {
    enum class Figure {
        temperature,  // [K] of `first`: mean over its area, at an instant
        contrast,     // [K] apparent, of `first` less `second` at an observer, likewise
        crossover     // [h] after the span's start, when both look equally warm
    };
    std::string name;
    Figure figure = Figure::temperature;
    RegionInput first, second;
    Instant at;
    std::size_t observer = 0;  // of the scene's
    std::string band;
    int number = 1;     // of the span's crossings, from 1
    std::string where;  // in the scene file
};

/// [[sensitivity]]: effect of uncertain numbers on results of the scene.
struct SensitivityInput {
    std::string name;
    std::vector<RangedInput> uncertain;
    std::vector<SensitivityOutput> outputs;
    std::size_t trajectories = 4;  // of Morris's screening; 0: none
    int levels = 4;
    bool exact = false;       // every scene of the screening is solved
    double tolerance = 0.05;  // [K] rms of temperatures that are combined instead
    std::string where;        // in the scene file
};

std::vector<SensitivityInput> read_sensitivities(const Section& root, const TerrainInput& terrain,
                                                 const std::vector<std::string>& materials,
                                                 const std::vector<BandInput>& bands,
                                                 const std::vector<ObserverInput>& observers,
                                                 const TimeInput& time);

}  // namespace diurna
