#include "terrain/objects/mesh_gate.hpp"

#include "materials/base/files.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;

}  // namespace

void check_mesh_bytes(const std::filesystem::path& file, std::string_view kind) {
    const std::string text = read_text(file, most_bytes), name = file.string();
    if (kind == ".obj") check_obj(name, text);
    if (kind == ".ply") check_ply(name, text);
    if (kind == ".stl") check_stl(name, text);
    if (kind == ".gltf") check_gltf(name, text, file.parent_path());
    if (kind == ".glb") check_glb(name, text, file.parent_path());
}

}  // namespace diurna
