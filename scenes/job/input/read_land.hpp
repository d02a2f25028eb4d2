#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>

#include "scenes/job/input/checked_names.hpp"

/// Ground cover and footprints that a scene reads from separate files.
namespace diurna {

/// Classes of a raster, with a material for some of them. These take precedence over the rules of
/// slope and height; polygons and shapes take precedence over these.
struct LandCoverInput {
    std::filesystem::path file;
    std::map<int, std::string> material;  // of a class
};

/// Polygons and lines of a vector file: ground of a material, or buildings.
struct ShapesInput {
    std::filesystem::path file;
    Confines confines{};                          // folders of the files beside it
    std::string name;                             // of the object that its buildings are
    std::string layer;                            // in a file of several; "": the only one
    std::string kind_field;                       // field of a shape's kind
    std::map<std::string, std::string> material;  // of a kind
    std::string default_material;                 // for other kinds; "": these are skipped
    double line_width = 6.0;                      // [m] of roads
    double largest_edge = 30.0;                   // [m]
    bool buildings = false;
    std::string height_field;
    double level_height = 1.0;  // [m] per unit of the height_field
    double default_height = std::numeric_limits<double>::quiet_NaN();  // NaN: skipped [m]
    std::string wall, roof;
    std::string kind = "building";  // its class in labels
};

/// The keys of [terrain.land_cover] and [[shapes]]; mistakes are noted in the sections.
LandCoverInput read_land_cover(const Section& section, const Reading& reading);
ShapesInput read_shapes_input(const Section& section, const Reading& reading);

}  // namespace diurna
