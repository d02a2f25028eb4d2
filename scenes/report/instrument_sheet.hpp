#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "terrain/place/instant.hpp"

namespace diurna {

/// What an instrument displays of all frames, as HTML with the pictures in it, each side halved.
/// They are read from the run's folder. `caption` tells an instant below its picture.
std::string instrument_sheet(const std::filesystem::path& folder, const std::string& observer,
                             const std::string& band, const std::string& instrument,
                             const std::vector<Instant>& frames,
                             const std::function<std::string(Instant)>& caption);

}  // namespace diurna
