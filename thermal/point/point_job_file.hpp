#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/document.hpp"
#include "thermal/point/point_job.hpp"

namespace diurna {

/// Reads a column file (TOML; scenes/KEYS.md lists its keys) and its weather. Throws InputError
/// with every mistake: file:line:column, the expected value, the nearest key. The files it names
/// must be within its confines (materials/base/confines.hpp).
///
/// - settings: "key=value", replace values of the file
PointJob read_column_job(const std::filesystem::path& file, bool allow_outside = false,
                         const std::vector<std::string>& settings = {});
/// The same for a document, for which it calls finish().
PointJob read_column_job(const Document& document);

}  // namespace diurna
