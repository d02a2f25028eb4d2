#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenes/plan/sequence.hpp"
#include "scenes/run/instrument_view.hpp"

namespace diurna {

/// Takes an instrument's pictures of the flux that seen_flux() has left in EXR files: planes of
/// what is measured beside it, counts, what is displayed, and the calibration. Returns what a
/// reader is to be reported.
///
/// A bolometer's picture goes on from those before it as far as its time constant reaches.
///
/// - wanted: numbers of the observer's frames
std::vector<std::string> take_pictures(const InstrumentView& view, const Prepared& prepared,
                                       const Sequence& sequence,
                                       std::span<const std::size_t> wanted,
                                       const std::filesystem::path& out);

}  // namespace diurna
