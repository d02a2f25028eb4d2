#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/input/read_observer.hpp"
#include "scenes/job/input/read_region.hpp"
#include "scenes/job/input/read_terrain.hpp"
#include "scenes/job/input/read_uncertain.hpp"

namespace diurna {

/// [[crossover]]: when two things have the same apparent temperature for an observer.
struct CrossoverInput {
    std::string name;
    RegionInput first, second;
    std::size_t observer = 0;        // of the scene's
    std::vector<std::string> bands;  // beyond 3 µm
    double threshold = 1.0;          // [K] below which contrast counts as lost
    double touching = 0.1;           // [K] a smaller minimum contrast counts as a tangent crossing
    bool refined = true;             // solved again with half the step, to measure the change
    std::vector<UncertainInput> uncertain;
    std::string where;  // in the scene file
};

std::vector<CrossoverInput> read_crossovers(const Section& root, const TerrainInput& terrain,
                                            const std::vector<std::string>& materials,
                                            const std::vector<BandInput>& bands,
                                            const std::vector<ObserverInput>& observers);

}  // namespace diurna
