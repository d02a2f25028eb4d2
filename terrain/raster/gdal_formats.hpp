#pragma once

#include <string>
#include <vector>

namespace diurna {

/// What a file is opened for with GDAL.
enum class GdalUse {
    elevation,
    classes,  // land cover: whole numbers, nothing lossy
    texture,
    facts,   // the program's report of a raster
    shapes,  // vector data
};

/// GDAL's drivers for it, null-terminated.
std::vector<const char*> gdal_drivers(GdalUse use);

/// Advice for a file in another format: the known ones, and a command that converts others.
std::string gdal_advice(GdalUse use);

/// Whether any use needs this driver.
bool is_gdal_driver_used(const std::string& driver);

}  // namespace diurna
