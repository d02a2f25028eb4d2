#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "materials/radiation/band.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

/// All frames of an observer in a band, on one colour scale, as HTML with the pictures in it. They
/// are read from the run's folder. `caption` tells an instant below its picture.
std::string contact_sheet(const std::filesystem::path& folder, const std::string& observer,
                          const Band& band, const std::vector<Instant>& frames,
                          const std::function<std::string(Instant)>& caption);

}  // namespace diurna
