#pragma once

#include <cstddef>
#include <filesystem>

namespace diurna {

/// Reads an ESRI ASCII grid word by word and throws InputError unless it holds exactly `posts`
/// values, each a complete finite number. GDAL itself reads `abc` as 0 and `1,5` as 1.5.
void check_ascii_grid(const std::filesystem::path& file, std::size_t posts);

}  // namespace diurna
