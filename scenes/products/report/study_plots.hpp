#pragma once

#include <filesystem>
#include <string>

namespace diurna {

/// Studies in a run's folder, or in its sub-folders with a study's name: their plots and a table of
/// their results, as a section of a page in HTML; "" if there are none. A file that cannot be read
/// is reported and skipped.
///
/// heat_sha256  of the run's scene, as `made_from` of a study has it
/// (scenes/studies/study_request.hpp):
///              a study of another one is shown with its scene and settings
std::string study_plots(const std::filesystem::path& folder, const std::string& heat_sha256);

}  // namespace diurna
