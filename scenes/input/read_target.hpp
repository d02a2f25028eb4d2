#pragma once

#include <filesystem>

#include "materials/base/section.hpp"
#include "scenes/input/target_input.hpp"
#include "terrain/objects/mesh_file.hpp"

namespace diurna {

/// The tables part, enclosure, lump, link, stream, contact, jet of an object, or of its part file;
/// the hours of `running` are those of all sources with `runs`, which without them release nothing.
/// Mistakes are noted where they stand.
///
/// file       a part file, or the one beside the mesh: NAME.parts.toml for NAME.obj; "": none
/// materials  that parts may name
TargetInput read_target(const Section& object, const std::filesystem::path& file,
                        const MeshFile& mesh, const Names& materials);

}  // namespace diurna
