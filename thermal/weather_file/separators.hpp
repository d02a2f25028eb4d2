#pragma once

#include <string>
#include <string_view>

namespace diurna {

/// A table with ',' between cells, line for line: one whose header has no comma but ';' or tabs is
/// converted, or one with blanks if header and first row have the same number of words. There,
/// decimal commas become '.'; cells with other commas get double quotes. `found` describes the
/// separator ("';'"), or is "" if the text is returned unchanged.
///
/// - skip: lines above the header
std::string with_commas(std::string_view text, int skip, std::string& found);

}  // namespace diurna
