#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/run/ledger.hpp"

namespace diurna {

/// What an observer's frames tell of themselves, each the worst of them.
///
/// - reported: what the ledger has of each frame, notes by name that begin with a number

/// For every band what the tables say of their error against the direct sum (Frame::notes); how
/// finely surfaces under snow or wet are distinguished in the frame that has most of them.
std::vector<std::string> errors_reported(const ObserverInput& observer,
                                         std::span<const Messages> reported);
/// For every band how many pixels its grey picture could not hold ("beyond.BAND").
std::vector<std::string> beyond_reported(const ObserverInput& observer,
                                         std::span<const Messages> reported);

}  // namespace diurna
