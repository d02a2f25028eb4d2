#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/objects/mesh_file.hpp"

namespace diurna {

/// Two flat patches of triangles in one place, with different triangulations.
struct DoubledPatch {
    std::vector<std::uint32_t> first, second;  // their triangles, ascending
    bool face_alike = false;
};

/// Patches at the same place as another one: for example a square and its reversed copy, which the
/// file (or its reader) cut along the other diagonal, so that no triangle of one equals one of the
/// other. A patch is connected by edges that its triangles traverse in opposite directions, flat to
/// 1e-4 rad and of one material; its place is that of its border, without vertices within straight
/// borders. Bent sheets of flat pieces are compared piece by piece.
///
/// - material: (part) a number for each material
/// returns  ordered by the first triangle of `second`; of three in one place each pair with the
///          first; without patches that have the same triangles
std::vector<DoubledPatch> doubled_patches(const MeshFile& mesh,
                                          std::span<const std::uint32_t> material);

}  // namespace diurna
