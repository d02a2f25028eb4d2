#pragma once

#include <string>
#include <vector>

#include "scenes/job/input/read_land.hpp"
#include "terrain/ground/ground_mesh.hpp"
#include "terrain/objects/prism.hpp"
#include "terrain/place/site.hpp"

/// Shapes of vector files on the elevation: fields, roads, buildings.
namespace diurna {

/// A shape on the ground, in (column, row) of the raster.
struct GroundShape {
    Footprint footprint;
    std::string material;  // "": by the rules (a hole of another shape)
};
/// All shapes that are ground and on the raster, in the order of their files; later ones on
/// top.
std::vector<GroundShape> ground_shapes(const std::vector<ShapesInput>& inputs, const Dem& dem,
                                       const Site& site);

/// A building of a file that is entirely on the raster, with ground at all corners.
struct ShapeBuilding {
    PrismSpec prism;  // without materials
    std::size_t input;
};
struct ShapeBuildings {
    std::vector<ShapeBuilding> building;
    std::vector<std::string> notes;  // what was skipped, a line per file
};
ShapeBuildings shape_buildings(const std::vector<ShapesInput>& inputs, const Dem& dem,
                               const Site& site, double tolerance);

}  // namespace diurna
