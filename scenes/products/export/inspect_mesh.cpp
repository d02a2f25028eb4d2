#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "materials/base/confines.hpp"
#include "materials/base/error.hpp"
#include "scenes/products/export/inspect.hpp"
#include "terrain/objects/facing.hpp"
#include "terrain/objects/mesh_file.hpp"
#include "terrain/objects/mesh_pieces.hpp"

namespace diurna {

namespace {

/// How many pieces hang together, of which so many are closed, and what was repaired or may be
/// wrong.
void add_pieces(MeshFile mesh, Found& found) {
    std::vector<std::string> material;
    for (const MeshFile::Part& part : mesh.part) material.push_back(part.material);
    const MeshPieces pieces = mesh_pieces(mesh.vertex, mesh.triangle);
    const Facing facing = turn_outward(mesh, material);
    found.fact.push_back({"pieces", {static_cast<long long>(pieces.size())}});
    found.fact.push_back({"closed_pieces", {static_cast<long long>(facing.closed)}});
    if (const std::string note = facing_note(facing); !note.empty()) mesh.notes.push_back(note);
    if (!mesh.notes.empty()) {
        found.fact.push_back({"notes", {mesh.notes.begin(), mesh.notes.end()}});
    }
    if (!mesh.warnings.empty()) {
        found.fact.push_back({"warnings", {mesh.warnings.begin(), mesh.warnings.end()}});
    }
}

}  // namespace

Found inspect_mesh(const std::filesystem::path& file, const InspectOptions& options) {
    const MeshFile mesh = read_mesh_file(file, confines_of(file, options.allow_outside));
    Eigen::Vector3d low = mesh.vertex.front(), high = low;
    for (const Eigen::Vector3d& v : mesh.vertex) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
    }
    struct Part {
        std::set<std::string> materials;
        long long facets = 0;
    };
    std::map<std::string, Part> parts;
    std::set<std::string> materials;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        const MeshFile::Part& part = mesh.part[mesh.part_of[t]];
        Part& of = parts[part.node];
        ++of.facets;
        if (part.material.empty()) continue;
        of.materials.insert(part.material);
        materials.insert(part.material);
    }
    const std::string kind = small_letters(file.extension().string());
    const bool metres = kind == ".gltf" || kind == ".glb";
    Found found{.kind = "mesh"};
    found.fact = {
        {"facets", {static_cast<long long>(mesh.triangle.size())}},
        {"vertices", {static_cast<long long>(mesh.vertex.size())}},
        {"parts", {static_cast<long long>(parts.size())}},
        {"unit",
         {std::string(metres ? "m (as in glTF)"
                             : "not in the file; set the key unit of the scene's object")}},
        {"low", {low.x(), low.y(), low.z()}},
        {"high", {high.x(), high.y(), high.z()}},
        {"size", {high.x() - low.x(), high.y() - low.y(), high.z() - low.z()}},
        {"materials", {materials.begin(), materials.end()}}};
    add_pieces(mesh, found);
    FoundTable table{"groups", {"group", "facets", "materials"}, {}};
    for (const auto& [name, part] : parts) {
        table.row.push_back({name, part.facets, fmt::format("{}", fmt::join(part.materials, " "))});
    }
    found.table.push_back(std::move(table));
    found.next = "use it as file of an [[object]] of a scene; diurna keys lists the keys";
    return found;
}

}  // namespace diurna
