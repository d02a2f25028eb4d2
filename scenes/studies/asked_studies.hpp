#pragma once

#include <span>
#include <string_view>

#include "scenes/studies/study_request.hpp"

namespace diurna {

/// A kind of study in a scene.
struct StudyKind {
    const char* word;  // of its tables, its verb and, in Python, its method
    const char* says;  // its description on the command line
    StudyFindings (*find)(const StudyRequest& request);
    const char* temperatures;  // meaning of `--temperatures`; null: not available
};

/// All of them, in the order of the list of commands.
std::span<const StudyKind> study_kinds();

/// Throws InputError if there is no study of that name.
const StudyKind& study_kind(std::string_view word);

}  // namespace diurna
