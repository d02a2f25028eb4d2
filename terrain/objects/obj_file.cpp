#include "terrain/objects/obj_file.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <iterator>

#include "materials/base/files.hpp"

namespace diurna {

void write_obj(const std::filesystem::path& file, const MeshFile& mesh,
               const std::string& comment) {
    std::string text = fmt::format("# {}\n# Metres, y up, front towards +z.\n", comment);
    const auto out = std::back_inserter(text);
    for (const Eigen::Vector3d& v : mesh.vertex) {
        // Never −0.00000: what is the same place shall be the same text.
        fmt::format_to(out, "v {:.5f} {:.5f} {:.5f}\n", -v.x() + 0.0, v.z() + 0.0, v.y() + 0.0);
    }
    for (std::size_t p = 0; p < mesh.part.size(); ++p) {
        fmt::format_to(out, "g {}\n", mesh.part[p].node);
        if (!mesh.part[p].material.empty()) {
            fmt::format_to(out, "usemtl {}\n", mesh.part[p].material);
        }
        for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
            if (mesh.part_of[t] != p) continue;
            const auto& [a, b, c] = mesh.triangle[t];
            fmt::format_to(out, "f {} {} {}\n", a + 1, b + 1, c + 1);
        }
    }
    write_whole_file(file, text);
}

}  // namespace diurna
