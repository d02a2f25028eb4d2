#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/input/read_observer.hpp"
#include "scenes/job/input/read_region.hpp"

namespace diurna {

/// [[contrast]]: contrast of targets, or of treatments of one, with their background.
struct ContrastInput {
    std::string name;
    std::vector<RegionInput> targets;
    std::vector<std::size_t> observers;  // of the scene's, whose pictures are taken
    std::vector<std::string> bands;      // of all of these; beyond 3 µm
    double ring = 1.0;                   // width of the background around, in target sizes
    double threshold = 2.0;              // [K] above which it counts as detected
    std::vector<double> ranges;          // [m] for the highest contrast
    std::string where;                   // in the scene file
};

std::vector<ContrastInput> read_contrasts(const Section& root, const TerrainInput& terrain,
                                          const std::vector<std::string>& materials,
                                          const std::vector<BandInput>& bands,
                                          const std::vector<ObserverInput>& observers);

}  // namespace diurna
