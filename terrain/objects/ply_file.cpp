#include "terrain/objects/ply_file.hpp"

#include <bit>
#include <sstream>
#include <utility>

#include "materials/base/files.hpp"

namespace diurna {

namespace {

static_assert(std::endian::native == std::endian::little, "write_ply writes memory as it is");

template <class T>
void put(std::ostream& out, T value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

void write_ply(const std::filesystem::path& file, std::span<const Eigen::Vector3d> vertex,
               std::span<const std::array<std::uint32_t, 3>> triangle) {
    std::ostringstream out(std::ios::binary);
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << vertex.size()
        << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
        << triangle.size() << "\nproperty list uchar uint vertex_indices\nend_header\n";
    for (const auto& v : vertex) {
        for (int k = 0; k < 3; ++k) put(out, v[k]);
    }
    for (const auto& corners : triangle) {
        put(out, std::uint8_t{3});
        for (const std::uint32_t corner : corners) put(out, corner);
    }
    write_whole_file(file, std::move(out).str());
}

}  // namespace diurna
