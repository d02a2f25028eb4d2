#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "materials/matter/material.hpp"

namespace diurna {

/// A triangle soup with one material per triangle, east-north-up [m] of the scene.
struct ObjectMesh {
    std::vector<Eigen::Vector3f> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;  // counterclockwise seen from outside
    std::vector<MaterialId> material;                    // (triangle)
};

}  // namespace diurna
