#include "scenes/studies/asked_studies.hpp"

#include <algorithm>
#include <string>

#include "materials/base/error.hpp"
#include "scenes/studies/contrast_study.hpp"
#include "scenes/studies/crossover_study.hpp"
#include "scenes/studies/detection_study.hpp"
#include "scenes/studies/sensitivity_study.hpp"
#include "scenes/studies/signature_study.hpp"

namespace diurna {

const std::array<StudyKind, 5>& study_kinds() {
    static constexpr const char* solved = "netCDF file of `solve`; else they are solved";
    static constexpr std::array<StudyKind, 5> all{{
        {"signature", "radiant and contrast intensity of objects in every direction: [[signature]]",
         signature_study, solved},
        {"detection", "ranges at which an instrument's display shows objects: [[detection]]",
         detection_study, solved},
        {"crossover", "when two things look equally warm to an observer: [[crossover]]",
         crossover_study, "netCDF file of `solve`; else they are solved, and kept at every step"},
        {"contrast", "how targets stand out from what is around them: [[contrast]]", contrast_study,
         solved},
        {"sensitivity", "what numbers that are not known well do to figures: [[sensitivity]]",
         sensitivity_study, nullptr},
    }};
    return all;
}

const StudyKind& study_kind(std::string_view word) {
    const auto& all = study_kinds();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const StudyKind& kind) { return kind.word == word; });
    if (found != all.end()) return *found;
    throw InputError("study", "found \"" + std::string(word) + "\"",
                     "expected signature, detection, crossover, contrast or sensitivity");
}

}  // namespace diurna
