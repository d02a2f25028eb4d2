#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "materials/base/confines.hpp"
#include "terrain/objects/file_mesh.hpp"

namespace diurna {

/// Readers by format: `name` is used in messages about `text`, the file's bytes. Each checks
/// numbers, counts against the size, and indices, and throws InputError at the first mistake, with
/// file:line for text formats.
MeshFile read_obj(const std::string& name, std::string_view text);
MeshFile read_ply(const std::string& name, std::string_view text);
MeshFile read_stl(const std::string& name, std::string_view text);
/// - folder: of its buffers, which must be within the confines
MeshFile read_gltf(const std::string& name, std::string_view text,
                   const std::filesystem::path& folder, const Confines& confines);
MeshFile read_glb(const std::string& name, std::string_view text,
                  const std::filesystem::path& folder, const Confines& confines);

/// A coordinate must be less than this in any unit: the Earth's circumference in hundredths of a
/// millimetre.
inline constexpr double most_coordinate = 4e12;
/// Cutting a polygon takes time with the square of its corners.
inline constexpr std::size_t most_corners = 4096;
/// Of a mesh file, or of a buffer that it names.
inline constexpr std::size_t most_mesh_bytes = std::size_t{1} << 30;

}  // namespace diurna
