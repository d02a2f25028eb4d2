#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace diurna {

/// Triangles as PLY (binary little endian), vertices as given.
void write_ply(const std::filesystem::path& file, std::span<const Eigen::Vector3d> vertex,
               std::span<const std::array<std::uint32_t, 3>> triangle);

/// Further values for each triangle of the file.
struct PlyFaces {
    std::span<const std::array<std::uint8_t, 3>> colour;  // (triangle) red, green, blue
    std::span<const float> temperature;                   // (triangle) [K], "temperature_K"
    std::vector<std::string> comments;                    // lines of the file's head
};
/// The same with these; faces have `red`, `green`, `blue` as bytes and `temperature_K` as float.
/// float.
void write_ply(const std::filesystem::path& file, std::span<const Eigen::Vector3d> vertex,
               std::span<const std::array<std::uint32_t, 3>> triangle, const PlyFaces& faces);

}  // namespace diurna
