#pragma once

#include <span>

#include "render/view/view.hpp"

namespace diurna {

/// Two views of one observer as one, each pixel by shares of either. Targets of both are kept,
/// those of `more` behind those of `view`.
///
/// - share: (pixel) of `more`, 0 to 1; where it is 0 the pixel is as in `view`
void add_view(View& view, const View& more, std::span<const float> share);

}  // namespace diurna
