#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/document.hpp"
#include "thermal/point/point_job.hpp"

namespace diurna {

/// Reads a column file (TOML; scenes/KEYS.md lists its keys) and its weather. Throws InputError
/// with every mistake: file:line:column, what was expected, the nearest key. The files it names lie
/// within its confines (materials/base/confines.hpp).
///
/// - settings: "key=value" in place of what the file says
PointJob read_column_job(const std::filesystem::path& file, bool allow_outside = false,
                         const std::vector<std::string>& settings = {});
/// The same of a document, which is finished.
PointJob read_column_job(const Document& document);

}  // namespace diurna
