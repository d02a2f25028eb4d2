#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/input/bands.hpp"
#include "scenes/input/read_observer.hpp"
#include "scenes/input/read_region.hpp"

namespace diurna {

/// [[contrast]]: how targets, or treatments of one, stand out from what is around them.
struct ContrastInput {
    std::string name;
    std::vector<RegionInput> targets;
    std::vector<std::size_t> observers;  // of the scene's, whose pictures are taken
    std::vector<std::string> bands;      // of all of these; beyond 3 µm
    double ring = 1.0;                   // width of the background around, times the target's size
    double threshold = 2.0;              // [K] above which it counts as seen
    std::vector<double> ranges;          // [m] to which the worst contrast is taken
    std::string where;                   // in the scene file
};

std::vector<ContrastInput> read_contrasts(const Section& root, const TerrainInput& terrain,
                                          const std::vector<std::string>& materials,
                                          const std::vector<BandInput>& bands,
                                          const std::vector<ObserverInput>& observers);

}  // namespace diurna
