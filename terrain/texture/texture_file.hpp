#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "materials/base/confines.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/geotransform.hpp"
#include "terrain/texture/texture.hpp"

namespace diurna {

/// One channel of a picture, and its georeference if the file has one.
struct TextureImage {
    std::string source;
    int columns = 0, rows = 0;
    std::vector<float> value;    // (row, column), the first row on top; NaN: no data
    bool georeferenced = false;  // has a geotransform and a CRS
    GeoTransform transform{};
    std::string crs_wkt;
};

/// Reads a channel, counted from 1, of a GeoTIFF, PNG, JPEG, ENVI, netCDF or ESRI ASCII file.
/// Throws InputError if it is missing, damaged, has no such channel or over 1e8 texels.
///
/// - confines: of its sidecars; default: its folder
TextureImage read_texture_image(const std::filesystem::path& file, int channel = 1,
                                const std::optional<Confines>& confines = {});

/// Converts east and north of the site [m] to texels (0, 0 the first one's outer corner) of a
/// georeferenced image: the polynomial of RasterTexture::Layout over a square of half-width `reach`
/// [m] around the site, at the site's level (a point 1 km higher and 10 km away is 1.6 m off, by
/// the tilt of its vertical). `worst` [texels]: its largest error in the square. Throws InputError
/// if the image's CRS cannot transform the site.
std::array<Eigen::Vector2d, 6> texels_from_site(const TextureImage& image, const Site& site,
                                                double reach, double* worst = nullptr);

}  // namespace diurna
