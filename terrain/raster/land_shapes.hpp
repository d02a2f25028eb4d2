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
    std::string kind;  // value of the class field; empty without one
    double height =
        std::numeric_limits<double>::quiet_NaN();  // of the height field [m]; NaN: empty
    std::size_t feature = 0;                       // of the file, from 1
    bool line = false;
    std::vector<Geodetic> ring;
    std::vector<std::vector<Geodetic>> hole;
};

/// Reads all polygons and lines of a GeoJSON (also one feature per line), ESRI Shapefile,
/// GeoPackage, KML, KMZ or FlatGeobuf, also inside a zip archive or a .gz; multi-part shapes are
/// split. A height is a number of metres or a text with its unit (written_height.hpp). Throws
/// InputError for a missing or damaged file, one without CRS, several layers with shapes if none is
/// named, a field that the layer does not have, a text that is no height, or more than a million
/// corners.
///
/// - confines: of its sidecars; default: its folder
/// - layer: in a file of several; "": the only one that has shapes; "*": all of them
std::vector<LandShape> read_shapes(const std::filesystem::path& file,
                                   const std::string& kind_field = "",
                                   const std::string& height_field = "",
                                   const std::optional<Confines>& confines = {},
                                   const std::string& layer = "");

/// A layer of a vector file and how many features it has.
struct ShapeLayer {
    std::string name;
    long long features = 0;
};
/// Throws InputError as read_shapes().
std::vector<ShapeLayer> shape_layers(const std::filesystem::path& file,
                                     const std::optional<Confines>& confines = {});

}  // namespace diurna
