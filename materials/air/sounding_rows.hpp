#pragma once

#include <string>
#include <vector>

#include "materials/base/csv.hpp"

namespace diurna {

/// A radiosonde's levels, as a table.
struct SoundingTable {
    CsvTable table;
    bool archive = false;              // from a university or a weather service, not one's own CSV
    std::vector<std::string> notes{};  // what a reader of the report should know
};

}  // namespace diurna
