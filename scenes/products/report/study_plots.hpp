#pragma once

#include <filesystem>
#include <string>

namespace diurna {

/// Studies in a run's folder, or in its sub-folders with a study's name: their plots and a table of
/// their results, as a section of a page in HTML; "" if there are none. A file that cannot be read
/// is reported and skipped.
std::string study_plots(const std::filesystem::path& folder);

}  // namespace diurna
