#include "terrain/objects/gltf_extensions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace diurna {

namespace {

using Json = nlohmann::json;

constexpr std::array followed{"KHR_mesh_quantization", "EXT_mesh_gpu_instancing"};
/// Beginnings of names of those that change no shape.
constexpr std::array<std::string_view, 12> shapeless{"KHR_materials_",
                                                     "KHR_texture_",
                                                     "EXT_texture_",
                                                     "MSFT_texture_",
                                                     "KHR_lights_",
                                                     "EXT_lights_",
                                                     "KHR_xmp",
                                                     "KHR_animation_pointer",
                                                     "EXT_mesh_features",
                                                     "EXT_instance_features",
                                                     "EXT_structural_metadata",
                                                     "KHR_techniques_"};
constexpr std::array packings{"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                              "KHR_meshopt_compression", "MPEG_buffer_circular"};

const Json& names(const Gltf& gltf, const char* key) {
    const Json& found = Gltf::member(gltf.all(), key);
    const bool fits =
        found.is_null() || (found.is_array() && std::all_of(found.begin(), found.end(),
                                                            [](auto& x) { return x.is_string(); }));
    if (!fits) throw gltf.fault(key, "is not an array of names");
    return found;
}

}  // namespace

void check_gltf_extensions(const Gltf& gltf) {
    for (const Json& one : names(gltf, "extensionsRequired")) {
        const auto& name = one.get_ref<const std::string&>();
        const bool known =
            std::any_of(followed.begin(), followed.end(), [&](auto* f) { return name == f; }) ||
            std::any_of(shapeless.begin(), shapeless.end(),
                        [&](std::string_view begin) { return name.starts_with(begin); });
        if (known) continue;
        throw InputError(
            gltf.name() + ": extensionsRequired",
            fmt::format("the mesh needs {}, which is not supported", name.substr(0, 80)),
            "export it without that extension");
    }
}

bool uses_extension(const Gltf& gltf, const char* name) {
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        for (const Json& one : names(gltf, key)) {
            if (one.get_ref<const std::string&>() == name) return true;
        }
    }
    return false;
}

std::string packing_of(const Json& packed) {
    for (const char* name : packings) {
        if (!Gltf::member(Gltf::member(packed, "extensions"), name).is_null()) return name;
    }
    return "";
}

}  // namespace diurna
