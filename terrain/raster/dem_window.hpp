#pragma once

#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// A part of a raster: its first post and its size.
struct PostWindow {
    int column, row, columns, rows;
};

/// Posts from one before to one after the circle of the options; all posts without a circle. Throws
/// InputError if the circle is outside.
PostWindow window_of(const Dem& dem, const DemOptions& options);

/// Replaces the raster's position by that of the window; heights are unchanged.
void move_to_window(Dem& dem, const PostWindow& window);

/// Crops a raster to the window.
void crop(Dem& dem, const PostWindow& window);

}  // namespace diurna
