#pragma once

#include <cstddef>
#include <vector>

#include "render/picture/grey_counts.hpp"

namespace diurna {

/// The bytes of a grey PNG, its scale as text "Scale".
std::vector<std::byte> grey_png(const GreyPicture& picture);

}  // namespace diurna
