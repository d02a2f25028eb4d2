#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "materials/modtran/fortran_text.hpp"

namespace diurna {

/// A column of a run's table: from the end of the column before to its own end.
struct Tape7Column {
    std::string name;
    std::size_t end;  // one past its last character
    bool may_be_blank = false;
};

/// Columns of a LOWTRAN7 tape7, the same for every run of one IEMSCT.
std::vector<Tape7Column> lowtran_columns(int emission);

/// Columns of a MODTRAN tape7 of an IEMSCT, from its line of headings, and for transmittance runs
/// also from the second one, which is then read. Throws InputError for missing headings.
std::vector<Tape7Column> modtran_columns(int emission, std::string_view heading,
                                         LineReader& source);

/// Columns of a convolved run (.7sc): headings are right-aligned over their numbers, one blank is
/// within a heading, and some headings have no numbers. TRANS is named TOT_TRANS.
/// The first may be FREQ [cm⁻¹], WAVLEN(MCRN) or WAVLEN (NM).
std::vector<Tape7Column> convolved_columns(std::string_view heading);

}  // namespace diurna
