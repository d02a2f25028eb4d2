#pragma once

#include <string>

#include "materials/base/section.hpp"

namespace diurna {

/// The path of an uncertain number, in a table of its own. One that affects neither light nor heat
/// is a mistake, which is noted.
std::string read_uncertain_key(const Section& section);

/// Converts a name to a valid file name.
std::string plain_name(std::string name);

}  // namespace diurna
