#include "scenes/job/input/read_region.hpp"

#include <algorithm>

#include "scenes/job/input/object_names.hpp"

namespace diurna {

namespace {

constexpr const char* material_prefix = "material:";
bool holds(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

RegionNames region_names(const TerrainInput& terrain, const std::vector<std::string>& materials) {
    RegionNames names{.all = {.what = "object, part or material", .known = {}},
                      .objects = {},
                      .materials = materials};
    add_objects(names.all, terrain);
    for (const Building& one : terrain.buildings) names.all.known.push_back(one.name);
    for (const auto& one : terrain.polygons) names.all.known.push_back(one.name);
    names.all.known.emplace_back("ground");  // what is no polygon of it
    names.objects = names.all.known;
    for (const ObjectInput& object : terrain.objects) {
        for (const PartInput& part : object.target.part) {
            if (part.name != "*") names.all.known.push_back(object.name + "/" + part.name);
        }
    }
    for (const std::string& material : materials) {
        names.all.known.push_back(material);
        names.all.known.push_back(material_prefix + material);
    }
    return names;
}

RegionInput region_named(const std::string& name, const RegionNames& known) {
    RegionInput region{.name = name};
    if (holds(known.objects, name)) {
        region.kind = RegionInput::Kind::object;
        region.object = name;
    } else if (holds(known.materials, name)) {
        region.material = name;
    } else if (name.starts_with(material_prefix)) {
        region.material = name.substr(std::string(material_prefix).size());
    } else if (const std::size_t slash = name.find('/'); slash != std::string::npos) {
        region.kind = RegionInput::Kind::part;
        region.object = name.substr(0, slash);
        region.part = name.substr(slash + 1);
    }
    return region;
}

}  // namespace diurna
