#pragma once

#include <string>

#include "terrain/place/instant.hpp"

namespace diurna {

/// A time in a weather file: ISO 8601, a blank allowed for the T. Where it has no offset from UTC,
/// `offset_h` is taken, NaN if there is none to take. Throws InputError(where) for anything else.
Instant stamp_in(std::string text, double offset_h, const std::string& where);

/// An offset from UTC [h]: "UTC", "Z", "+02:00", "-05:30". False if the word is none.
bool offset_in(const std::string& word, double& offset_h);

}  // namespace diurna
