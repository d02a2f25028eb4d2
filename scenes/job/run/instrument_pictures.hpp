#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenes/job/plan/sequence.hpp"
#include "scenes/job/run/instrument_view.hpp"

namespace diurna {

/// Computes an instrument's pictures from the flux in the EXR files of seen_flux(): planes of the
/// measured signal, counts, display picture, and the calibration. Returns messages for the
/// report.
///
/// A bolometer's picture depends on previous ones within the reach of its time constant.
///
/// - wanted: numbers of the observer's frames
std::vector<std::string> take_pictures(const InstrumentView& view, const Prepared& prepared,
                                       const Sequence& sequence,
                                       std::span<const std::size_t> wanted,
                                       const std::filesystem::path& out);

}  // namespace diurna
