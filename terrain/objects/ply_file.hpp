#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

namespace diurna {

/// Triangles as PLY (binary little endian), vertices as given.
void write_ply(const std::filesystem::path& file, std::span<const Eigen::Vector3d> vertex,
               std::span<const std::array<std::uint32_t, 3>> triangle);

}  // namespace diurna
