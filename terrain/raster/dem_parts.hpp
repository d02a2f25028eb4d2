#pragma once

#include <filesystem>

#include "terrain/raster/dem.hpp"

/// What reading a raster is made of: one file (dem_file.cpp), its reference system (dem_crs.cpp),
/// several as one (dem.cpp).
namespace diurna {

constexpr double most_posts = 5e8;

struct PostWindow {
    int column, row, columns, rows;
};
/// Posts from one before to one after the circle of the options; all without one.
PostWindow window_of(const Dem& dem, const DemOptions& options);

/// The heights of a file, its window alone or the whole, voids as NaN.
Dem read_tile(const std::filesystem::path& file, const DemOptions& options, bool whole);

/// The same coordinate reference system; latitudes and longitudes.
bool same_reference(const Dem& a, const Dem& b);
bool is_geographic(const Dem& dem);

/// Notes how far the raster's datum lies from WGS84, if PROJ does not know the way: it then takes
/// latitude and longitude as they are.
void note_datum(Dem& dem);
/// Notes a raster that lies far from the UTM zone it names. A wrong neighbour zone with plausible
/// eastings cannot be told.
void note_zone(Dem& dem);

}  // namespace diurna
