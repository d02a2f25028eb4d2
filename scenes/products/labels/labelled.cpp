#include "scenes/products/labels/labelled.hpp"

#include <algorithm>
#include <set>

namespace diurna {

std::vector<Labelled> labelled_objects(const Scene& scene, const World& world) {
    std::vector<Labelled> objects{{.name = world.objects.front(), .kind = ""}};
    for (const GroundPolygon& ground : scene.terrain.polygons) {
        objects.push_back({ground.name, ground.kind, ground.heading_deg});
    }
    for (const Building& building : scene.terrain.buildings) {
        objects.push_back({building.name, building.kind, building.heading_deg});
    }
    for (const ObjectInput& object : scene.terrain.objects) {
        objects.push_back({object.name, object.kind, object.placing.heading_deg});
    }
    // Behind these are files' buildings, of those files that have any.
    for (std::size_t id = objects.size(); id < world.objects.size(); ++id) {
        const auto& shapes = scene.terrain.shapes;
        const auto from = std::find_if(shapes.begin(), shapes.end(), [&](const ShapesInput& s) {
            return s.buildings && s.name == world.objects[id];
        });
        objects.push_back({.name = world.objects[id],
                           .kind = from == shapes.end() ? "building" : from->kind,
                           .group = true});
    }
    return objects;
}

std::vector<std::string> class_list(const std::vector<Labelled>& objects) {
    std::set<std::string> kinds;
    for (const Labelled& object : objects) {
        if (!object.kind.empty()) kinds.insert(object.kind);
    }
    return {kinds.begin(), kinds.end()};
}

std::size_t class_index(const std::vector<std::string>& classes, const std::string& kind) {
    return static_cast<std::size_t>(std::lower_bound(classes.begin(), classes.end(), kind) -
                                    classes.begin());
}

}  // namespace diurna
