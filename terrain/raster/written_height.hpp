#pragma once

#include <optional>
#include <string_view>

namespace diurna {

/// Parses a height as written in maps, in metres: "12", "12.5 m", "12,5", "35 ft", "30'", "6' 4\"".
/// The whole text is read; nullopt: not a height ("3 storeys", "10-12", the ambiguous "1,200").
/// Units: terrain/raster/height_unit.hpp, and inches after feet.
std::optional<double> written_height(std::string_view text);

}  // namespace diurna
