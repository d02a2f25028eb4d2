#include "terrain/objects/ply_file.hpp"

#include <bit>
#include <cassert>
#include <sstream>
#include <utility>

#include "materials/base/files.hpp"

namespace diurna {

namespace {

static_assert(std::endian::native == std::endian::little,
              "write_ply needs a little-endian machine");

template <class T>
void put(std::ostream& out, T value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

/// - faces: null: corners alone
void write(const std::filesystem::path& file, std::span<const Eigen::Vector3d> vertex,
           std::span<const std::array<std::uint32_t, 3>> triangle, const PlyFaces* faces) {
    std::ostringstream out(std::ios::binary);
    out << "ply\nformat binary_little_endian 1.0\n";
    if (faces != nullptr) {
        for (const std::string& line : faces->comments) out << "comment " << line << "\n";
    }
    out << "element vertex " << vertex.size()
        << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
        << triangle.size() << "\nproperty list uchar uint vertex_indices\n";
    if (faces != nullptr) {
        out << "property uchar red\nproperty uchar green\nproperty uchar blue\n"
               "property float temperature_K\n";
    }
    out << "end_header\n";
    for (const auto& v : vertex) {
        for (int k = 0; k < 3; ++k) put(out, v[k]);
    }
    for (std::size_t t = 0; t < triangle.size(); ++t) {
        put(out, std::uint8_t{3});
        for (const std::uint32_t corner : triangle[t]) put(out, corner);
        if (faces == nullptr) continue;
        for (const std::uint8_t share : faces->colour[t]) put(out, share);
        put(out, faces->temperature[t]);
    }
    write_whole_file(file, std::move(out).str());
}

}  // namespace

void write_ply(const std::filesystem::path& file, std::span<const Eigen::Vector3d> vertex,
               std::span<const std::array<std::uint32_t, 3>> triangle) {
    write(file, vertex, triangle, nullptr);
}

void write_ply(const std::filesystem::path& file, std::span<const Eigen::Vector3d> vertex,
               std::span<const std::array<std::uint32_t, 3>> triangle, const PlyFaces& faces) {
    assert(faces.colour.size() == triangle.size() && faces.temperature.size() == triangle.size());
    write(file, vertex, triangle, &faces);
}

}  // namespace diurna
