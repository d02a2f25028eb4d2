#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "terrain/objects/mesh_file.hpp"

namespace diurna {

/// What was found of triangles in a mesh that lie in the place of others, or have no area.
struct WeldedFaces {
    std::size_t removed = 0;  // of the same material as the first there, whichever way they face
    std::size_t back_to_back = 0;  // kept: the other way round and of another material
    std::size_t inner = 0;         // removed, both: walls between bodies that touch
    std::size_t flat = 0;          // removed: their corners lie on one line
    /// Parts whose triangles lie in one place and face the same way, of two materials.
    std::optional<std::array<std::uint32_t, 2>> contested;
};

/// Takes out of a mesh what lies there twice: as two layers, the same face would close a sheet
/// (each edge has two triangles), and a reversed copy of a sheet would be two that know nothing of
/// each other. A triangle is flat where its height is below 1e-9 of its longest edge. Triangles are
/// in one place that have the same corners; even patches that fill the same border, whichever way
/// they are cut (doubled_patches.hpp).
///
/// Where bodies touch, the wall between them lies there twice, and neither is seen: both are taken
/// out, so that the bodies are one. Such walls are those along whose border an even number of other
/// triangles goes on; a sheet written twice has none there, and one of the two is kept.
///
/// - material: (part) the name of its material
WeldedFaces weld_faces(MeshFile& mesh, std::span<const std::string> material);

}  // namespace diurna
