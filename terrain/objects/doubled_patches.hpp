#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/objects/mesh_file.hpp"

namespace diurna {

/// Two even patches of triangles in one place, cut along other lines within it.
struct DoubledPatch {
    std::vector<std::uint32_t> first, second;  // their triangles, ascending
    bool face_alike = false;
};

/// Patches that lie in the place of another: as a square and its reversed copy do whose files (or
/// whose readers) cut them along the other diagonal, so that no triangle of one is one of the
/// other. A patch is what hangs together by edges that its triangles go along in opposite
/// directions, level to 1e-4 rad and of one material; it is where its border is, vertices in the
/// midst of straight borders aside. Bent sheets of even pieces are compared piece by piece.
///
/// - material: (part) a number for each material
/// returns  by the first triangle of `second`; of three in one place each pair with the first; none
///          whose triangles are the same
std::vector<DoubledPatch> doubled_patches(const MeshFile& mesh,
                                          std::span<const std::uint32_t> material);

}  // namespace diurna
