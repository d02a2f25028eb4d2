#pragma once

#include <string>

#include "materials/base/section.hpp"

namespace diurna {

/// The path of a number that is not known well, in a table of its own. One that neither light nor
/// heat depend on is a mistake, which is noted.
std::string read_uncertain_key(const Section& section);

/// A name made fit for a file's.
std::string plain_name(std::string name);

}  // namespace diurna
