#pragma once

#include <filesystem>

#include "scenes/studies/study_request.hpp"

namespace CLI {
class App;
}

namespace diurna {

/// A verb for each kind of study: crossover, contrast, signature, detection, sensitivity
/// (scenes/studies/asked_studies.hpp).
void add_study_verbs(CLI::App& app);

/// Prints the results of studies, and the files in a folder with all of them. Throws
/// std::runtime_error if a heat balance has not converged.
void tell(const StudyFindings& found, const std::filesystem::path& out);

}  // namespace diurna
