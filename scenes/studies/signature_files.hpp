#pragma once

#include <string>
#include <vector>

#include "scenes/studies/signature.hpp"

namespace diurna {

/// The rows as CSV, its header first.
///
/// - utc_offset: [s] of the scene's clock
std::string signature_csv(const SignatureReport& report, double utc_offset);

/// Settings, definitions and, by instant and band, the minimum, mean and maximum of the rows.
std::string signature_json(const SignatureInput& input, const SignatureReport& report,
                           const std::vector<std::string>& notes, double utc_offset);

/// Discs of the hemisphere above the object, a row for each instant, for each band one of the
/// intensity and one of the contrast: its front up, level at the rim, vertical in the middle.
std::string signature_svg(const SignatureInput& input, const SignatureReport& report,
                          double utc_offset);

}  // namespace diurna
