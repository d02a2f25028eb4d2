#pragma once

#include <filesystem>

#include "materials/base/section.hpp"
#include "scenes/job/input/target_input.hpp"
#include "terrain/objects/mesh_file.hpp"

namespace diurna {

/// The tables part, enclosure, lump, link, stream, contact, jet of an object, or of its part file;
/// the hours of `running` apply to all sources with `runs`, which release nothing without them.
/// Mistakes are noted at their position.
///
/// file       a part file, or the one beside the mesh: NAME.parts.toml for NAME.obj; "": none
/// materials  allowed names for parts
TargetInput read_target(const Section& object, const std::filesystem::path& file,
                        const MeshFile& mesh, const Names& materials);

}  // namespace diurna
