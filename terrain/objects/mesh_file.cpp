#include "terrain/objects/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "terrain/objects/mesh_readers.hpp"

namespace diurna {

MeshFile read_mesh_file(const std::filesystem::path& file, const std::optional<Confines>& given) {
    const std::string name = file.string(), kind = small_letters(file.extension().string());
    constexpr std::array known{".obj", ".ply", ".stl", ".gltf", ".glb"};
    if (std::find(known.begin(), known.end(), kind) == known.end()) {
        throw InputError(name, fmt::format("found a file \"{}\", expected one of {}", kind,
                                           fmt::join(known, " ")));
    }
    const std::string read = read_text(file, most_mesh_bytes);
    if (read.starts_with("\xFF\xFE") || read.starts_with("\xFE\xFF")) {
        throw InputError(name, "is UTF-16 text", "save it as UTF-8 or ASCII");
    }
    const std::string_view text =
        std::string_view(read).substr(read.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    if (kind == ".obj") return read_obj(name, text);
    if (kind == ".ply") return read_ply(name, text);
    if (kind == ".stl") return read_stl(name, text);
    const Confines confines = given ? *given : confines_of(file);
    return kind == ".glb" ? read_glb(name, text, file.parent_path(), confines)
                          : read_gltf(name, text, file.parent_path(), confines);
}

}  // namespace diurna
