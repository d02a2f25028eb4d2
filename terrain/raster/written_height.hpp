#pragma once

#include <optional>
#include <string_view>

namespace diurna {

/// Metres of a height as maps write it: "12", "12.5 m", "12,5", "35 ft", "30'", "6' 4\"". The whole
/// text is read; none: it is no height ("3 storeys", "10-12", "1,200", which may be either).
/// Units: terrain/raster/height_unit.hpp, and inches behind feet.
std::optional<double> written_height(std::string_view text);

}  // namespace diurna
