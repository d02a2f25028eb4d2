#pragma once

#include <filesystem>
#include <span>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"
#include "scenes/job/input/read_air.hpp"

namespace diurna {

/// A file of n and k must cover every band of the scene's pictures, because its first and last rows
/// would be used for everything outside. Otherwise a mistake of the material, with the band that is
/// farthest outside. For a gloss with effective_index only up to 4 µm, beyond which another index
/// is used; not required for a metal with it.
///
/// - section: a table of [material], read before as `material`
void check_index_reach(const Section& section, const Material& material,
                       std::span<const SeenRange> ranges);

}  // namespace diurna
