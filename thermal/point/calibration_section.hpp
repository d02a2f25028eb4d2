#pragma once

#include <optional>

#include "materials/base/section.hpp"
#include "thermal/point/calibration.hpp"

namespace diurna {

/// [calibrate] of a column file, if it has one. Mistakes are noted.
std::optional<Calibration> read_calibration(const Section& root);

}  // namespace diurna
