#pragma once

#include <filesystem>
#include <vector>

#include "materials/base/files_read.hpp"

namespace diurna {

/// Files that no export of a run may replace: those in its folder, or in that of the sweep around
/// it, that its manifest.json lists, and the inputs of the run, wherever it was started from. Some
/// may not exist.
///
/// - folder: of the run, with or without a manifest.json
std::vector<FileRead> files_of_run(const std::filesystem::path& folder);

}  // namespace diurna
