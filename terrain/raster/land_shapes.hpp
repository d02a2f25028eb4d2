#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/confines.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// A polygon or line of a vector file, by geodetic corners (height 0), not closed.
struct LandShape {
    std::string kind;  // what the class field says; empty without one
    double height =
        std::numeric_limits<double>::quiet_NaN();  // of the height field [m]; NaN: empty
    std::size_t feature = 0;                       // of the file, from 1
    bool line = false;
    std::vector<Geodetic> ring;
    std::vector<std::vector<Geodetic>> hole;
};

/// Reads all polygons and lines of a GeoJSON, ESRI Shapefile or GeoPackage; parts of a multi-shape
/// one by one. A height is a number of metres or a text with its unit (written_height.hpp). Throws
/// InputError for a missing or damaged file, one without CRS, a field that no layer has, a text
/// that is no height, or more than a million corners.
///
/// - confines: of its sidecars; without, those of its folder
std::vector<LandShape> read_shapes(const std::filesystem::path& file,
                                   const std::string& kind_field = "",
                                   const std::string& height_field = "",
                                   const std::optional<Confines>& confines = {});

}  // namespace diurna
