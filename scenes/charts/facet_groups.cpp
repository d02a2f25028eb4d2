#include "scenes/charts/facet_groups.hpp"

#include <map>
#include <utility>

namespace diurna {

namespace {

/// What the materials of a target's parts represent; of others there is none.
std::map<MaterialId, std::string> part_names(const Prepared& prepared, std::size_t id) {
    std::map<MaterialId, std::string> names;
    for (const TargetFacets& target : prepared.world.targets) {
        if (static_cast<std::size_t>(target.id) != id) continue;
        const ObjectInput& input = prepared.scene.terrain.objects[target.object];
        for (const auto& [material, part] : target.part) {
            const int named = input.target.part_of[part];
            const std::string name = named < 0 ? "*" : input.target.part[std::size_t(named)].name;
            names[material] = name == "*" ? input.mesh->part[part].node : name;
        }
    }
    return names;
}

std::vector<FacetGroup> listed_names(std::map<std::string, std::vector<std::uint32_t>> members) {
    std::vector<FacetGroup> groups;
    for (auto& [name, facets] : members) groups.push_back({name, std::move(facets)});
    return groups;
}

}  // namespace

std::vector<FacetGroup> material_groups(const FacetSet& facets, const MaterialLibrary& materials) {
    std::map<std::string, std::vector<std::uint32_t>> members;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        members[materials[facets.material[f]].kind()].push_back(static_cast<std::uint32_t>(f));
    }
    return listed_names(std::move(members));
}

std::vector<FacetGroup> object_groups(const Prepared& prepared) {
    const FacetSet& facets = prepared.world.surfaces();
    std::vector<FacetGroup> all;
    for (const std::string& name : prepared.world.objects) all.push_back({name, {}});
    for (std::size_t f = 0; f < facets.size(); ++f) {
        all[static_cast<std::size_t>(facets.object[f])].facet.push_back(
            static_cast<std::uint32_t>(f));
    }
    std::erase_if(all, [](const FacetGroup& group) { return group.facet.empty(); });
    return all;
}

std::vector<ObjectParts> part_groups(const Prepared& prepared) {
    const FacetSet& facets = prepared.world.surfaces();
    const std::size_t first = 1 + prepared.scene.terrain.polygons.size();  // the others are ground
    std::map<std::size_t, std::map<std::string, std::vector<std::uint32_t>>> members;
    std::map<std::size_t, std::map<MaterialId, std::string>> names;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const auto object = static_cast<std::size_t>(facets.object[f]);
        if (object < first) continue;
        if (!names.contains(object)) names[object] = part_names(prepared, object);
        const MaterialId material = facets.material[f];
        const auto part = names[object].find(material);
        members[object][part != names[object].end() ? part->second
                                                    : prepared.scene.materials[material].kind()]
            .push_back(static_cast<std::uint32_t>(f));
    }
    std::vector<ObjectParts> all;
    for (auto& [object, parts] : members) {
        if (parts.size() < 2) continue;
        all.push_back({prepared.world.objects[object], listed_names(std::move(parts))});
    }
    return all;
}

}  // namespace diurna
