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

/// One channel of a picture, and where on Earth it lies if the file says so.
struct TextureImage {
    std::string source;
    int columns = 0, rows = 0;
    std::vector<float> value;    // (row, column), the first row on top; NaN: no data
    bool georeferenced = false;  // has place and CRS
    GeoTransform transform{};
    std::string crs_wkt;
};

/// Reads a channel, counted from 1, of a GeoTIFF, PNG, JPEG, ENVI, netCDF or ESRI ASCII file.
/// Throws InputError for one that is missing, damaged, of no such channel or of over 1e8 texels.
///
/// - confines: of its sidecars; without, those of its folder
TextureImage read_texture_image(const std::filesystem::path& file, int channel = 1,
                                const std::optional<Confines>& confines = {});

/// Places in texels (0, 0 the first one's outer corner) of a georeferenced image, as the polynomial
/// of RasterTexture::Layout over a square of half-width `reach` [m] around the site, in the site's
/// east and north, at its level: a kilometre higher, ten away, verticals lean by 1.6 m. `worst`
/// [texels]: its greatest error at points of the square. Throws InputError where the image's CRS
/// cannot say where the site is.
std::array<Eigen::Vector2d, 6> texels_from_site(const TextureImage& image, const Site& site,
                                                double reach, double* worst = nullptr);

}  // namespace diurna
