#pragma once

#include <string>
#include <vector>

#include "scenes/studies/contrast.hpp"

namespace diurna {

/// Why a target's clutter is not defined, and what to do; "" where it is defined.
std::string why_no_clutter(const ContrastRow& row, const ObserverInput& observer);

/// A line for each target, observer, instant and band. Undefined values are empty.
///
/// - scene: with the observers that the input names; times are on its clock
std::string contrast_csv(const ContrastInput& input, const ContrastReport& report,
                         const Scene& scene);

/// Settings, definition of each measure, and for each target, band and observer the pictures with
/// the highest and the lowest contrast, the share of pictures above the threshold, and contrast
/// over range. Undefined values are null, with a `why`.
std::string contrast_json(const ContrastInput& input, const ContrastReport& report,
                          const Scene& scene, const std::vector<std::string>& notes);

/// Root-sum-square contrast over the hours: a chart for each band and observer, a line for each
/// target.
std::string contrast_svg(const ContrastInput& input, const ContrastReport& report,
                         const Scene& scene);

}  // namespace diurna
