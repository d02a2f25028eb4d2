#pragma once

#include <array>
#include <string_view>

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// A kind of study that a scene may ask for.
struct StudyKind {
    const char* word;  // of its tables, its verb and, in Python, its method
    const char* says;  // of it on the command line
    StudyFindings (*find)(const StudyRequest& request);
    const char* temperatures;  // what `--temperatures` stands for; null: it takes none
};

const std::array<StudyKind, 5>& study_kinds();

/// Throws InputError where there is none of that name.
const StudyKind& study_kind(std::string_view word);

}  // namespace diurna
