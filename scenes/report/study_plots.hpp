#pragma once

#include <filesystem>
#include <string>

namespace diurna {

/// What studies have left in a run's folder, or below it in a folder that has a study's name: their
/// plots and a table of their answers, as a section of a page in HTML; "" where there is none. A
/// file that cannot be read is reported of and skipped.
std::string study_plots(const std::filesystem::path& folder);

}  // namespace diurna
