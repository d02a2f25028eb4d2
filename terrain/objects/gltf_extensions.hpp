#pragma once

#include <string>

#include "terrain/objects/gltf_json.hpp"

namespace diurna {

/// Throws InputError for an extension that the file requires and that is not followed, by its name.
/// Followed are KHR_mesh_quantization and EXT_mesh_gpu_instancing; those of materials, textures,
/// lights and metadata change no shape.
void check_gltf_extensions(const Gltf& gltf);

/// Whether the file says that it uses an extension.
bool uses_extension(const Gltf& gltf, const char* name);

/// How the bytes of a buffer, a view of it or a primitive are packed, by the extension's name;
/// "": not.
std::string packing_of(const nlohmann::json& packed);

}  // namespace diurna
