#pragma once

#include <filesystem>
#include <vector>

#include "materials/radiation/band.hpp"
#include "scenes/report/picture_series.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

/// Frames of an observer in a band, each on a scale of its own and on one of all, read from the
/// run's folder; so small that the series has room in a page.
PictureSeries contact_sheet(const std::filesystem::path& folder, const std::string& observer,
                            const Band& band, const std::vector<Instant>& frames);

/// What each side of so many pictures is divided by in a page.
int page_shrink(int width, int height, std::size_t pictures);

}  // namespace diurna
