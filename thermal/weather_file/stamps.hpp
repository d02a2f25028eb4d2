#pragma once

#include <string>

#include "terrain/place/instant.hpp"

namespace diurna {

/// A time in a weather file: ISO 8601, a blank allowed instead of the T, slashes in the date.
/// Without an offset from UTC, `offset_h` is used, NaN if there is none. Throws InputError(where)
/// for anything else.
Instant stamp_in(std::string text, double offset_h, const std::string& where);

/// An offset from UTC [h]: "UTC", "Z", "+02:00", "-05:30". False for any other word.
bool offset_in(const std::string& word, double& offset_h);

}  // namespace diurna
