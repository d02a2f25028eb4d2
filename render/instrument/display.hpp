#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/instrument/instrument.hpp"

namespace diurna {

/// Counts as a picture of 8 bits.
///
/// - linear: from the share `low` of the pixels to the share `high`, linearly
/// - plateau: histogram equalisation, with each count limited to the share `plateau` of the pixels
///   (Vickers 1996); counts that do not occur take no grey levels
/// - manual: `span` counts around `level`
std::vector<std::uint8_t> displayed(std::span<const std::uint16_t> counts,
                                    const Electronics& electronics);

}  // namespace diurna
