#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "materials/base/csv.hpp"

namespace diurna {

/// Removes levels of a sounding at which the balloon sank for a moment or the sensor read slightly
/// high, and levels that are plainly wrong: the fewest levels whose removal makes heights rise and
/// pressures fall from level to level, so that one bad level costs no good one. Nothing is removed,
/// and the reader refuses the sounding, if more than `most` of the levels (and more than three)
/// would have to go, or if a level has no pressure.
///
/// table     rows from the ground up
/// height    column of heights
/// pressure  column of pressures
/// most      share of the levels that may be skipped
/// returns   a note of what was skipped; "" if nothing was
std::string leave_out_bounces(CsvTable& table, std::size_t height, std::size_t pressure,
                              double most = 0.1);

}  // namespace diurna
