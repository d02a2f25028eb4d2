#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "materials/base/confines.hpp"
#include "terrain/objects/file_mesh.hpp"

namespace diurna {

/// Readers by kind: `name` stands in messages about `text`, the file's bytes. Each checks that
/// numbers are numbers, counts fit the size, indices mean something, and throws InputError at the
/// first thing that cannot be, with file:line where it is text.
MeshFile read_obj(const std::string& name, std::string_view text);
MeshFile read_ply(const std::string& name, std::string_view text);
MeshFile read_stl(const std::string& name, std::string_view text);
/// - folder: where it names its buffers, which lie within the confines
MeshFile read_gltf(const std::string& name, std::string_view text,
                   const std::filesystem::path& folder, const Confines& confines);
MeshFile read_glb(const std::string& name, std::string_view text,
                  const std::filesystem::path& folder, const Confines& confines);

/// A coordinate is less than this in any unit: the Earth's circumference in hundredths of a
/// millimetre.
inline constexpr double most_coordinate = 4e12;
/// Cutting a polygon takes the square of its corners.
inline constexpr std::size_t most_corners = 4096;
/// Of a mesh's file, or a buffer that it names.
inline constexpr std::size_t most_mesh_bytes = std::size_t{1} << 30;

}  // namespace diurna
