#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "materials/base/csv.hpp"

namespace diurna {

/// Leaves out levels of a sounding at which the balloon went down for a moment, or the sensor read
/// a little too much, and levels that are plainly wrong: as few as make heights rise and pressures
/// fall from level to level, so that one bad level costs no good one. They are left in, for the
/// reader to refuse, where they are more than `most` of the levels (and more than three), or where
/// a level has no pressure of its own.
///
/// table     rows from the ground up
/// height    column of heights
/// pressure  column of pressures
/// most      share of the levels that may be skipped
/// returns   a note of what was skipped; "" for nothing
std::string leave_out_bounces(CsvTable& table, std::size_t height, std::size_t pressure,
                              double most = 0.1);

}  // namespace diurna
