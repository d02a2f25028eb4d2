#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/run/ledger.hpp"

namespace diurna {

/// Messages about an observer's frames, each for the worst of them.
///
/// - reported: the ledger's entry for each frame, notes by name that begin with a number

/// For every band the error of the tables against the direct sum (Frame::notes); the error due to
/// the number of samples (sample_error.hpp); and the resolution of surfaces with snow or water
/// in the frame with the most of them.
std::vector<std::string> errors_reported(const ObserverInput& observer,
                                         std::span<const Messages> reported);
/// What uncertain values change, of the first frame with planes sigma.BAND.
std::vector<std::string> changes_reported(std::span<const Messages> reported);
/// For every band the number of pixels outside its grey picture's scale ("beyond.BAND").
std::vector<std::string> beyond_reported(const ObserverInput& observer,
                                         std::span<const Messages> reported);

}  // namespace diurna
