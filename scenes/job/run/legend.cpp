#include "scenes/job/run/legend.hpp"

#include <cstdint>
#include <numeric>
#include <set>

#include "scenes/job/world/objects.hpp"
#include "scenes/products/labels/labelled.hpp"

namespace diurna {

namespace {

/// A part's material as it is, in flight, as a sheet, and as its back.
bool is_made_of(const std::string& name, const std::string& material) {
    return name == material || name == material + " (sheet)" || name == material + " (back)";
}

}  // namespace

Legend legend_of(const Prepared& prepared) {
    const World& world = prepared.world;
    const Scene& scene = prepared.scene;
    Legend legend;
    std::vector<std::set<std::size_t>> used(world.objects.size());
    std::set<std::size_t> any;
    const FacetSet& surfaces = world.surfaces();
    for (std::size_t f = 0; f < surfaces.size(); ++f) {
        used[static_cast<std::size_t>(surfaces.object[f])].insert(index(surfaces.material[f]));
        any.insert(index(surfaces.material[f]));
    }
    // A copy is made of what the object is of which it has the facets.
    std::vector<std::size_t> alike(used.size());
    std::iota(alike.begin(), alike.end(), std::size_t{0});
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        const Copy& copy = world.copies[c];
        alike[static_cast<std::size_t>(copy.object)] =
            static_cast<std::size_t>(world.facets.object[copy.first]);
    }
    const auto name_of = [&](std::size_t id) {
        return scene.materials[MaterialId{static_cast<std::uint16_t>(id)}].name;
    };
    for (const std::size_t id : any) legend.material.push_back({id, name_of(id)});
    const std::vector<Labelled> labelled = labelled_objects(scene, world);
    for (std::size_t id = 0; id < labelled.size(); ++id) {
        legend.object.push_back({id, labelled[id].name, labelled[id].kind});
    }
    const std::size_t first = 1 + scene.terrain.polygons.size() + scene.terrain.buildings.size();
    std::size_t id = first;
    for (std::size_t k = 0; k < scene.terrain.objects.size(); ++k) {
        const ObjectInput& object = scene.terrain.objects[alike[id] - first];
        for (std::size_t p = 0; p < object.mesh->part.size(); ++p) {
            Legend::Part part{id, p, object.mesh->part[p].node, object.material[p], {}};
            const std::string own = object.target.given() ? part_material_name(object, p)
                                    : object.airspeed > 0.0
                                        ? part.material + " of " + object.name + " (in flight)"
                                        : part.material;
            for (const std::size_t m : used[alike[id]]) {
                if (is_made_of(name_of(m), own)) part.materials.push_back(m);
            }
            legend.part.push_back(std::move(part));
        }
        ++id;
    }
    return legend;
}

}  // namespace diurna
