#pragma once

#include <vector>

#include "scenes/job/input/checked_names.hpp"
#include "scenes/job/input/object_input.hpp"

namespace diurna {

/// One table [[object]], or each of its copies (read_copies.hpp).
std::vector<ObjectInput> read_object(const Section& section, Reading& reading);

}  // namespace diurna
