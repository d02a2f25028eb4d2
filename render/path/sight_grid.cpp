#include "render/path/sight_grid.hpp"

#include <algorithm>

namespace diurna {

PathExtent path_extent(const View& view, double ground_height_km) {
    PathExtent extent;
    extent.observer_height_km = ground_height_km + 1e-3 * view.observer_height;
    if (view.sighting.empty()) return extent;
    extent.least_range_km = 1e-3 * double{view.extent.near};
    extent.most_range_km = 1e-3 * double{view.extent.far};
    extent.least_height_km = ground_height_km + 1e-3 * double{view.extent.low};
    extent.most_height_km = ground_height_km + 1e-3 * double{view.extent.high};
    return extent;
}

SightGrid::SightGrid(const PathExtent& of)
    : extent(of),
      root_low(std::cbrt(of.least_range_km)),
      root_high(std::max(std::cbrt(of.most_range_km), root_low + 1e-4)),
      segments(chord_segments(std::max(std::abs(of.observer_height_km - of.least_height_km),
                                       std::abs(of.observer_height_km - of.most_height_km)))) {
    if (extent.most_height_km - extent.least_height_km < 1e-4) {
        extent.least_height_km -= 5e-5;
        extent.most_height_km += 5e-5;
    }
}

}  // namespace diurna
