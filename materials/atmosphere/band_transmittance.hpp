#pragma once

#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/bins.hpp"

namespace diurna {

/// Transmittance to the end of a line only, (bin): the fastest function for it.
std::vector<double> transmittance(const BandModel& model, const SightLine& line, BinRange bins);

}  // namespace diurna
