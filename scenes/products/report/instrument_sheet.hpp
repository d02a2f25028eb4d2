#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/products/report/picture_series.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

/// An instrument's display pictures of frames, read from the run's folder, reduced for a page.
PictureSeries instrument_sheet(const std::filesystem::path& folder, const std::string& observer,
                               const std::string& band, const std::string& instrument,
                               const std::vector<Instant>& frames);

}  // namespace diurna
