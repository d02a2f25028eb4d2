#pragma once

#include <filesystem>
#include <string>

#include "materials/base/section.hpp"
#include "materials/matter/library.hpp"

namespace diurna {

/// A material read from a table of any document (library, scene, column file), all with the same
/// keys: scenes/KEYS.md lists them.
///
/// base      what `like = "NAME"` starts from. Without `like`, a table whose `name` is known
///           there starts from that one, so `name = "asphalt"` alone is the library's asphalt and
///           `name = "asphalt", albedo = 0.08` is that asphalt made darker
///
/// name      the material's name where the table has no `name` of its own
///
/// Mistakes are noted in the section's document, which throws them all in finish().
Material read_material(const Section& section, const MaterialLibrary& base,
                       const std::string& name = "");

}  // namespace diurna
