#pragma once

#include <string>
#include <vector>

#include "materials/base/csv.hpp"

namespace diurna {

/// A radiosonde's levels, as a table.
struct SoundingTable {
    CsvTable table;
    bool archive = false;              // from a university or a weather service, not plain CSV
    std::vector<std::string> notes{};  // repairs and conversions, for the report
};

}  // namespace diurna
