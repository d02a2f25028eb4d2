#include "scenes/world/objects.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "materials/base/document.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::pair<const char*, double>, 5> units = {
    {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}}};

std::string known_material(const Section& section, const std::string& key,
                           const std::vector<std::string>& materials) {
    const std::string name = section.text(key);
    if (!name.empty() && std::find(materials.begin(), materials.end(), name) == materials.end()) {
        section.mistake(key, fmt::format("no material \"{}\"", name),
                        did_you_mean(name, materials));
    }
    return name;
}

double metres_per_unit(const Section& section) {
    std::vector<std::string> names;
    for (const auto& [name, metres] : units) names.emplace_back(name);
    const std::string unit = section.word_or("unit", "m", names);
    const auto found = std::find_if(units.begin(), units.end(),
                                    [&](const auto& entry) { return unit == entry.first; });
    const double scale = section.number_or("scale", 1.0, 1e-6, 1e6);
    return scale * (found != units.end() ? found->second : 1.0);
}

MeshFile read_mesh(const Section& section, const fs::path& file) {
    if (!section.has("mesh")) {
        section.mistake("mesh", "missing, expected a file: .obj, .ply, .stl, .gltf or .glb");
        return {};
    }
    if (!fs::is_regular_file(file)) {
        section.mistake("mesh", fmt::format("no such file: {}", file.string()));
        return {};
    }
    try {
        return read_mesh_file(file);
    } catch (const InputError& error) {
        section.mistake("mesh",
                        error.mistakes().front().where + ": " + error.mistakes().front().problem);
        return {};
    }
}

/// The material of each part: what [object.parts] says of its node or its material's name, else
/// the object's own.
std::vector<std::string> part_materials(const Section& section, const MeshFile& mesh,
                                        const std::vector<std::string>& materials) {
    std::vector<std::string> material(mesh.part.size());
    if (section.has("material")) {
        std::fill(material.begin(), material.end(), known_material(section, "material", materials));
    }
    std::vector<std::string> names;
    for (const MeshFile::Part& part : mesh.part) {
        for (const std::string& name : {part.node, part.material}) {
            if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
                names.push_back(name);
            }
        }
    }
    const Section table = section.section("parts");
    for (const std::string& key : table.free_keys()) {
        const std::string chosen = known_material(table, key, materials);
        bool any = false;
        for (std::size_t p = 0; p < mesh.part.size(); ++p) {
            if (mesh.part[p].node != key && mesh.part[p].material != key) continue;
            material[p] = chosen;
            any = true;
        }
        if (!any && !mesh.part.empty()) {
            table.mistake(key, fmt::format("no such part; the mesh has {}", fmt::join(names, ", ")),
                          did_you_mean(key, names));
        }
    }
    for (std::size_t p = 0; p < material.size(); ++p) {
        if (!material[p].empty()) continue;
        section.mistake("material", fmt::format("missing, and no [object.parts] names part \"{}\"",
                                                mesh.part[p].node));
        break;
    }
    return material;
}

}  // namespace

ObjectInput read_object_input(const Section& section, const fs::path& folder,
                              const std::vector<std::string>& materials) {
    ObjectInput object;
    object.file = folder / section.text_or("mesh", "");
    object.mesh = read_mesh(section, object.file);
    const std::vector<double> place = section.numbers("place_m", 2);
    object.place = {place[0], place[1]};
    object.height_above_ground = section.number_or("height_above_ground_m", 0.0, -100.0, 1e4);
    const std::string extension = object.file.extension().string();
    const bool upright = extension == ".stl" || extension == ".ply";
    const std::string up = section.word_or("up", upright ? "z" : "y", {"y", "z"});
    object.placing = {.heading_deg = section.number_or("heading_deg", 0.0, -360.0, 360.0),
                      .up = up == "z" ? UpAxis::z : UpAxis::y,
                      .metres = metres_per_unit(section),
                      .largest_edge = section.number_or("largest_edge_m", 0.5, 0.01, 100.0)};
    object.material = part_materials(section, object.mesh, materials);
    return object;
}

ObjectMesh object_mesh(const ObjectInput& object, const Eigen::Vector3d& ground,
                       const MaterialLibrary& materials) {
    Placing placing = object.placing;
    placing.base = ground + Eigen::Vector3d(0.0, 0.0, object.height_above_ground);
    std::vector<MaterialId> material;
    for (const std::string& name : object.material) material.push_back(materials.find(name));
    return placed_mesh(object.mesh, placing, material);
}

GroundPatch ground_patch(const ObjectInput& object) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& v : object.mesh.vertex) box.extend(v);
    Eigen::Vector3d size = box.sizes() * object.placing.metres;
    if (object.placing.up == UpAxis::y) std::swap(size.y(), size.z());
    const double reach = 0.5 * size.head<2>().norm() + 2.0 * size.z();
    GroundPatch patch{.ring = {}, .largest_edge = reach / 12.0};
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        patch.ring.push_back(object.place + reach * Eigen::Vector2d(x, y));
    }
    return patch;
}

}  // namespace diurna
