#pragma once

#include <filesystem>
#include <vector>

#include "materials/radiation/band.hpp"
#include "scenes/products/report/picture_series.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

/// Frames of an observer in a band, each on its own scale and on a common one, read from the run's
/// folder; reduced so that the series fits in a page.
PictureSeries contact_sheet(const std::filesystem::path& folder, const std::string& observer,
                            const Band& band, const std::vector<Instant>& frames);

/// Divisor of each side of this many pictures in a page.
int page_shrink(int width, int height, std::size_t pictures);

}  // namespace diurna
