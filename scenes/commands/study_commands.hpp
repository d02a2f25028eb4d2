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

/// What studies have found, and the files in a folder that have it all. Throws std::runtime_error
/// where a heat balance has not converged.
void tell(const StudyFindings& found, const std::filesystem::path& out);

}  // namespace diurna
