#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/confines.hpp"
#include "terrain/raster/geotransform.hpp"

namespace diurna {

/// One band (channel) of a raster file, as its file declares it.
struct BandFacts {
    std::string name, unit, type;   // "Float32"; name and unit may be empty
    std::optional<double> no_data;  // as declared
    double least = 0.0,
           most = 0.0;  // of finite valid values; NaN without any
    double mean = 0.0;
    long long valid = 0;  // pixels
    bool alpha = false;   // marks the valid pixels of the other bands
};

inline constexpr std::size_t most_bands_described = 64;

/// Contents of any raster file: elevation, classes, temperatures or a picture.
struct RasterFacts {
    std::string driver;  // GDAL's: "GTiff"
    int columns = 0, rows = 0;
    int bands = 0;
    std::vector<BandFacts> band;  // the first ones, up to most_bands_described
    std::optional<GeoTransform> transform;
    std::string crs;   // its name, with the authority's code if it has one; "": none
    std::string unit;  // of map places: "metre", "degree"; "": none
    std::vector<std::string> variable{};  // of netCDF with several variables (no bands then)
};

/// Reads GeoTIFF, PNG, JPEG, ENVI, ESRI ASCII, DTED, SRTM, USGS DEM, netCDF (with several
/// variables: no bands); the described bands are read completely.
/// Throws InputError if it is missing, damaged, larger than its bytes can hold or has over 1e9
/// values.
///
/// - confines: of its sidecars; default: its folder
RasterFacts read_raster_facts(const std::filesystem::path& file,
                              const std::optional<Confines>& confines = {});

}  // namespace diurna
