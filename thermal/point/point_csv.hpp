#pragma once

#include <string>

#include "thermal/point/run_column.hpp"

namespace diurna {

/// The result as text: `time,surface_temperature_K,...`, comment lines first for what was modelled.
std::string column_csv(const PointResult& result);

}  // namespace diurna
