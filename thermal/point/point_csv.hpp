#pragma once

#include <string>

#include "thermal/point/run_column.hpp"

namespace diurna {

/// The result as text, its header `time,surface_temperature_K,...` first; without its note.
std::string column_csv(const PointResult& result);

}  // namespace diurna
