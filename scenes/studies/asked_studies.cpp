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

std::span<const StudyKind> study_kinds() {
    static constexpr const char* solved =
        "netCDF file of temperatures, written by solve (default: computed)";
    static constexpr StudyKind all[]{
        {"signature", "radiant and contrast intensity of objects in all directions: [[signature]]",
         signature_study, solved},
        {"detection", "detection ranges of objects on an instrument's display: [[detection]]",
         detection_study, solved},
        {"contrast", "contrast of targets with their background: [[contrast]]", contrast_study,
         solved},
        {"crossover", "times at which two regions have equal apparent temperature: [[crossover]]",
         crossover_study,
         "netCDF file of temperatures, written by solve (default: computed and stored at every "
         "step)"},
        {"sensitivity", "effect of uncertain inputs on results: [[sensitivity]]", sensitivity_study,
         nullptr},
    };
    return all;
}

const StudyKind& study_kind(std::string_view word) {
    const std::span<const StudyKind> all = study_kinds();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const StudyKind& kind) { return kind.word == word; });
    if (found != all.end()) return *found;
    std::string words;
    for (const StudyKind& kind : all) {
        if (!words.empty()) words += &kind == &all.back() ? " or " : ", ";
        words += kind.word;
    }
    throw InputError("study", "found \"" + std::string(word) + "\"", "expected " + words);
}

}  // namespace diurna
