#include "scenes/input/read_object.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace diurna {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::pair<const char*, double>, 5> units = {
    {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}}};

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
                                        const Reading& reading) {
    std::vector<std::string> material(mesh.part.size());
    if (section.has("material")) {
        std::fill(material.begin(), material.end(), reading.material(section, "material"));
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
        const std::string chosen = reading.material(table, key);
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

ObjectInput read_object(const Section& section, Reading& reading) {
    ObjectInput object;
    object.name = reading.object(section);
    object.file = reading.folder / section.text_or("mesh", "");
    object.mesh = read_mesh(section, object.file);
    object.place = place(section, "place_m");
    object.height_above_ground = section.number_or("height_above_ground_m", 0.0, -100.0, 1e4);
    const std::string extension = object.file.extension().string();
    const bool upright = extension == ".stl" || extension == ".ply";
    const std::string up = section.word_or("up", upright ? "z" : "y", {"y", "z"});
    object.placing = {.heading_deg = section.number_or("heading_deg", 0.0, -360.0, 360.0),
                      .up = up == "z" ? UpAxis::z : UpAxis::y,
                      .metres = metres_per_unit(section),
                      .largest_edge = section.number_or("largest_edge_m", 0.5, 0.01, 100.0)};
    object.material = part_materials(section, object.mesh, reading);
    return object;
}

}  // namespace diurna
