#pragma once

#include <string>

#include "terrain/objects/gltf_json.hpp"

namespace diurna {

/// Throws InputError, with its name, for an extension that the file requires and that is not
/// supported. Supported are KHR_mesh_quantization and EXT_mesh_gpu_instancing; those of materials,
/// textures, lights and metadata do not change shapes.
void check_gltf_extensions(const Gltf& gltf);

/// Whether the file lists an extension as used.
bool uses_extension(const Gltf& gltf, const char* name);

/// Name of the extension that compresses a buffer, a view of it or a primitive; "": not
/// compressed.
std::string packing_of(const nlohmann::json& packed);

}  // namespace diurna
