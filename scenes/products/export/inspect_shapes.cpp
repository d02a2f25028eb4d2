#include <algorithm>

#include "materials/base/confines.hpp"
#include "scenes/products/export/inspect.hpp"
#include "terrain/raster/land_shapes.hpp"

namespace diurna {

Found inspect_shapes(const std::filesystem::path& file, const InspectOptions& options) {
    const Confines confines = confines_of(file, options.allow_outside);
    const std::vector<LandShape> shapes = read_shapes(file, "", "", confines, "*");
    const std::vector<ShapeLayer> layers = shape_layers(file, confines);
    long long lines = 0, corners = 0;
    double south = 90.0, north = -90.0, west = 540.0, east = -540.0;
    for (const LandShape& shape : shapes) {
        lines += shape.line;
        corners += static_cast<long long>(shape.ring.size());
        for (const Geodetic& corner : shape.ring) {
            south = std::min(south, corner.latitude_deg);
            north = std::max(north, corner.latitude_deg);
            west = std::min(west, corner.longitude_deg);
            east = std::max(east, corner.longitude_deg);
        }
    }
    Found found{.kind = "shapes"};
    found.fact = {{"polygons", {static_cast<long long>(shapes.size()) - lines}},
                  {"lines", {lines}},
                  {"corners", {corners}},
                  {"latitudes_deg", {south, north}},
                  {"longitudes_deg", {west, east}}};
    if (layers.size() > 1) {
        FoundTable table{"layers", {"layer", "features"}, {}};
        for (const ShapeLayer& one : layers) table.row.push_back({one.name, one.features});
        found.table.push_back(std::move(table));
    }
    found.next = layers.size() > 1
                     ? "use it as file of [[shapes]] of a scene, with one of its layers as layer"
                     : "use it as file of [[shapes]] of a scene";
    return found;
}

}  // namespace diurna
