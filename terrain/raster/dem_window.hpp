#pragma once

#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// A part of a raster, by its first post and its posts.
struct PostWindow {
    int column, row, columns, rows;
};

/// Posts from one before to one after the circle of the options; all without one. Throws InputError
/// where the circle lies outside.
PostWindow window_of(const Dem& dem, const DemOptions& options);

/// The place of a window's posts instead of the raster's; heights are left as they are.
void move_to_window(Dem& dem, const PostWindow& window);

/// Leaves the window alone of a raster.
void crop(Dem& dem, const PostWindow& window);

}  // namespace diurna
