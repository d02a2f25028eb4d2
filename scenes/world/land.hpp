#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "terrain/ground/ground_mesh.hpp"
#include "terrain/objects/prism.hpp"
#include "terrain/place/site.hpp"

/// Ground cover and footprints that a scene takes from files of its own.
namespace diurna {

class Section;

/// Classes of a raster, with a material for some of them. Where it knows one it goes before the
/// rules of slope and height; polygons and shapes go before it.
struct LandCoverInput {
    std::filesystem::path file;
    std::map<int, std::string> material;  // of a class
};

/// Polygons and lines of a vector file: ground of a material, or buildings.
struct ShapesInput {
    std::filesystem::path file;
    std::string name;                             // of the object that its buildings are
    std::string kind_field;                       // what tells the kind of a shape
    std::map<std::string, std::string> material;  // of a kind
    std::string default_material;                 // of other kinds; "": these are left out
    double line_width = 6.0;                      // [m] of roads
    double largest_edge = 30.0;                   // [m]
    bool buildings = false;
    std::string height_field;
    double default_height = std::numeric_limits<double>::quiet_NaN();  // NaN: left out [m]
    std::string wall, roof;
};

/// The keys of [terrain.land_cover] and [[shapes]]; mistakes are noted in the sections.
LandCoverInput read_land_cover(const Section& section, const std::filesystem::path& folder,
                               const std::vector<std::string>& materials);
ShapesInput read_shapes_input(const Section& section, const std::filesystem::path& folder,
                              const std::vector<std::string>& materials);

/// A shape on the ground, in (column, row) of the raster.
struct GroundShape {
    Footprint footprint;
    std::string material;  // "": by the rules (the hole of another)
};
/// All shapes that are ground and lie on the raster, in the order of their files; later ones on
/// top.
std::vector<GroundShape> ground_shapes(const std::vector<ShapesInput>& inputs, const Dem& dem,
                                       const Site& site);

/// A building of a file that stands wholly on the raster, with ground at all corners.
struct ShapeBuilding {
    PrismSpec prism;  // without materials
    std::size_t input;
};
std::vector<ShapeBuilding> shape_buildings(const std::vector<ShapesInput>& inputs, const Dem& dem,
                                           const Site& site, double tolerance);

}  // namespace diurna
