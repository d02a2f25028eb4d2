#include "terrain/raster/gdal_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace diurna {

namespace {

constexpr unsigned bit(GdalUse use) { return 1u << static_cast<unsigned>(use); }

constexpr unsigned elevation = bit(GdalUse::elevation), classes = bit(GdalUse::classes),
                   texture = bit(GdalUse::texture), facts = bit(GdalUse::facts),
                   shapes = bit(GdalUse::shapes);
constexpr unsigned rasters = elevation | classes | texture | facts;

struct Format {
    const char* driver;  // GDAL's
    const char* name;    // ""; named by another entry
    unsigned uses;
};

// A picture of 8 bits is no elevation, and JPEG would change classes.
constexpr std::array formats{
    Format{"GTiff", "GeoTIFF", rasters},
    Format{"DTED", "DTED", elevation | facts},
    Format{"SRTMHGT", "SRTM HGT", elevation | facts},
    Format{"USGSDEM", "USGS DEM", elevation | facts},
    Format{"AAIGrid", "ESRI ASCII", rasters},
    Format{"EHdr", "ESRI .bil and .flt", elevation | classes | facts},
    Format{"ENVI", "ENVI", rasters},
    Format{"HFA", "Erdas .img", elevation | classes | facts},
    Format{"netCDF", "netCDF", rasters},
    Format{"PNG", "PNG", texture | facts},
    Format{"JPEG", "JPEG", texture | facts},
    Format{"GeoJSON", "GeoJSON (also one feature per line)", shapes},
    Format{"GeoJSONSeq", "", shapes},
    Format{"ESRI Shapefile", "ESRI Shapefile (its .shp, or a zip of all its files)", shapes},
    Format{"GPKG", "GeoPackage", shapes},
    Format{"LIBKML", "KML, KMZ", shapes},
    Format{"FlatGeobuf", "FlatGeobuf", shapes},
    Format{"MEM", "", 0},  // rasters while they are written
};

}  // namespace

std::vector<const char*> gdal_drivers(GdalUse use) {
    std::vector<const char*> drivers;
    for (const Format& format : formats) {
        if ((format.uses & bit(use)) != 0) drivers.push_back(format.driver);
    }
    drivers.push_back(nullptr);
    return drivers;
}

std::string gdal_advice(GdalUse use) {
    std::vector<std::string> names;
    for (const Format& format : formats) {
        if ((format.uses & bit(use)) != 0 && *format.name != '\0') names.emplace_back(format.name);
    }
    return fmt::format("known formats: {}; {}", fmt::join(names, ", "),
                       use == GdalUse::shapes
                           ? "ogr2ogr shapes.gpkg FILE converts others to GeoPackage"
                           : "gdal_translate IN OUT.tif converts others to GeoTIFF");
}

bool is_gdal_driver_used(const std::string& driver) {
    return std::any_of(formats.begin(), formats.end(),
                       [&](const Format& format) { return driver == format.driver; });
}

}  // namespace diurna
