#pragma once

#include <string>
#include <vector>

#include "scenes/studies/contrast.hpp"

namespace diurna {

/// A line for each target, observer, instant and band. Empty where there is nothing to take it of.
///
/// - scene: whose observers the input names; its clock is that of the times
std::string contrast_csv(const ContrastInput& input, const ContrastReport& report,
                         const Scene& scene);

/// Settings, what each measure is, and of each target and band the worst picture, the share of
/// pictures above the threshold, and contrast over range.
std::string contrast_json(const ContrastInput& input, const ContrastReport& report,
                          const Scene& scene, const std::vector<std::string>& notes);

/// Root-sum-square contrast over the hours: a chart for each band and observer, a line for each
/// target.
std::string contrast_svg(const ContrastInput& input, const ContrastReport& report,
                         const Scene& scene);

}  // namespace diurna
