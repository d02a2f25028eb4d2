#pragma once

#include <cstddef>
#include <filesystem>

namespace diurna {

/// Reads an ESRI ASCII grid word by word and throws InputError unless it holds exactly `posts`
/// values, each a whole finite number. GDAL alone takes `abc` for 0 and `1,5` for 1.5.
void check_ascii_grid(const std::filesystem::path& file, std::size_t posts);

}  // namespace diurna
