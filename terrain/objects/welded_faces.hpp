#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "terrain/objects/mesh_file.hpp"

namespace diurna {

/// Triangles of a mesh at the place of others, or without area.
struct WeldedFaces {
    std::size_t removed = 0;       // same material as the first one there, any orientation
    std::size_t back_to_back = 0;  // kept: opposite orientation, another material
    std::size_t inner = 0;         // removed, both: walls between touching bodies
    std::size_t flat = 0;          // removed: corners on one line
    /// Parts of two materials whose triangles are in one place and face the same way.
    std::optional<std::array<std::uint32_t, 2>> contested;
};

/// Removes duplicate triangles from a mesh: as two layers, the same face would close a sheet (each
/// edge has two triangles), and a reversed copy of a sheet would be two uncoupled sheets. A
/// triangle is flat if its height is below 1e-9 of its longest edge. Triangles are in one place if
/// they have the same corners; flat patches if they fill the same border, with any triangulation
/// (doubled_patches.hpp).
///
/// Where bodies touch, the wall between them exists twice, and neither is visible: both are
/// removed, so that the bodies become one. These are walls whose border has an even number of other
/// triangles; a sheet written twice has none there, and one of the two is kept.
///
/// - material: (part) the name of its material
WeldedFaces weld_faces(MeshFile& mesh, std::span<const std::string> material);

}  // namespace diurna
