#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace diurna {

/// Looks through a mesh's file before a library is given it: whether its numbers are numbers, its
/// counts fit its size, its indices mean something. A file that lies about itself would else hang
/// the library, exhaust memory or be read as something that it does not say.
///
/// - kind: ".obj", ".ply", ".stl", ".gltf" or ".glb"
///
/// Throws InputError at the first thing that cannot be, with file:line where it is text.
void check_mesh_bytes(const std::filesystem::path& file, std::string_view kind);

/// The same, by kind: `name` stands in what is told of `text`, the file's bytes.
void check_obj(const std::string& name, std::string_view text);
void check_ply(const std::string& name, std::string_view text);
void check_stl(const std::string& name, std::string_view text);
/// `folder` is where it names its buffers.
void check_gltf(const std::string& name, std::string_view text,
                const std::filesystem::path& folder);
void check_glb(const std::string& name, std::string_view text, const std::filesystem::path& folder);

/// A coordinate is less than this in any unit: the Earth's circumference in hundredths of a
/// millimetre.
inline constexpr double most_coordinate = 4e12;
/// Cutting a polygon takes the square of its corners.
inline constexpr std::size_t most_corners = 4096;

}  // namespace diurna
