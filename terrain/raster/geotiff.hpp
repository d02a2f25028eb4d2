#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "terrain/raster/dem.hpp"

namespace diurna {

/// One quantity of every post of a raster.
struct RasterBand {
    std::string name;
    std::span<const float> value;  // (row, column) as in the Dem; NaN: no value
    std::string unit = "";         // "K"; empty: not written
};

/// Cloud-optimised: tiles, with overviews (means) if larger than one tile, the directory first;
/// plain if GDAL has no such driver.
enum class TiffLayout { plain, cloud };

/// Writes quantities of an elevation raster's posts as a GeoTIFF with its position and CRS (32-bit
/// float, DEFLATE, NaN for no data), whole or not at all. Throws std::runtime_error with the
/// reason.
void write_geotiff(const std::filesystem::path& file, const Dem& dem,
                   const std::vector<RasterBand>& bands, TiffLayout layout = TiffLayout::plain);

}  // namespace diurna
