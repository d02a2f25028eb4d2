#pragma once

#include <filesystem>
#include <span>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"
#include "scenes/input/read_air.hpp"

namespace diurna {

/// A file of n and k has to reach from end to end of every band that the scene is looked at in: its
/// first and last rows would stand for all that is beyond them. Mistakes of the material otherwise,
/// by the band that is furthest out. Up to 4 µm of a gloss with effective_index, whose index is
/// another beyond; not of a metal with it.
///
/// - section: a table of [material], read before as `material`
void check_index_reach(const Section& section, const Material& material,
                       std::span<const SeenRange> ranges);

}  // namespace diurna
