#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace diurna {

/// A mesh as its file gives it: one part per node and material of the file.
struct MeshFile {
    struct Part {
        std::string node;      // or group (OBJ); may be empty
        std::string material;  // as named in the file; may be empty
    };
    std::vector<Eigen::Vector3d> vertex{};  // the file's own axes and unit
    std::vector<std::array<std::uint32_t, 3>> triangle{};
    std::vector<std::uint16_t> part_of{};  // (triangle)
    std::vector<Part> part{};
    std::vector<std::string> notes{};     // what was repaired or skipped
    std::vector<std::string> warnings{};  // possible errors in the file
};

}  // namespace diurna
