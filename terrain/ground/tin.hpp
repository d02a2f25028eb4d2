#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace diurna {

/// A triangulated irregular network over the posts of a raster.
struct Tin {
    std::vector<std::array<std::int32_t, 2>> post;       // (vertex) column, row
    std::vector<std::array<std::uint32_t, 3>> triangle;  // counterclockwise seen from above
                                                         // (columns east, rows south)
};

}  // namespace diurna
