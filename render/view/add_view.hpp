#pragma once

#include <span>

#include "render/view/view.hpp"

namespace diurna {

/// Combines two views of one observer, each pixel with a share of each. Targets of both are
/// retained, those of `more` after those of `view`.
///
/// - share: (pixel) of `more`, 0 to 1; where it is 0 the pixel is as in `view`
void add_view(View& view, const View& more, std::span<const float> share);

}  // namespace diurna
