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
           most = 0.0;  // of what is finite and valid by its mask; NaN where nothing is
    double mean = 0.0;
    long long valid = 0;  // pixels
    bool alpha = false;   // says which pixels of the other bands are valid
};

inline constexpr std::size_t most_bands_described = 64;

/// What any raster file holds, be it elevation, classes, temperatures or a picture.
struct RasterFacts {
    std::string driver;  // GDAL's: "GTiff"
    int columns = 0, rows = 0;
    int bands = 0;
    std::vector<BandFacts> band;  // of the first ones, most_bands_described at most
    std::optional<GeoTransform> transform;
    std::string crs;   // its name, with the authority's code if it has one; "": none
    std::string unit;  // of map places: "metre", "degree"; "": none
    std::vector<std::string> variable{};  // of netCDF with several, which has no bands
};

/// Reads GeoTIFF, PNG, JPEG, ENVI, ESRI ASCII, DTED, SRTM, USGS DEM, netCDF (of several
/// variables there: no bands); the bands described are read through.
/// Throws InputError for one that is missing, damaged, larger than its bytes can hold or of over
/// 1e9 values.
///
/// - confines: of its sidecars; without, those of its folder
RasterFacts read_raster_facts(const std::filesystem::path& file,
                              const std::optional<Confines>& confines = {});

}  // namespace diurna
