#pragma once

#include <cstddef>
#include <vector>

#include "render/picture/grey_counts.hpp"

namespace diurna {

/// The bytes of a grey TIFF of one band, compressed by DEFLATE with horizontal differencing, its
/// scale as image description.
std::vector<std::byte> grey_tiff(const GreyPicture& picture);

}  // namespace diurna
