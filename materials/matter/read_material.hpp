#pragma once

#include <filesystem>
#include <string>

#include "materials/base/section.hpp"
#include "materials/matter/library.hpp"

namespace diurna {

/// A material read from a table of any document (library, scene, column file), all with the same
/// keys: scenes/KEYS.md lists them.
///
/// base      materials that `like = "NAME"` may start from. Without `like`, a table whose `name` is
///           a known one starts from that material, so `name = "asphalt"` alone is the library's
///           asphalt and `name = "asphalt", albedo = 0.08` is a darker asphalt
///
/// name      the material's name if the table has no `name`
///
/// Mistakes are noted in the section's document, which throws them all in finish().
Material read_material(const Section& section, const MaterialLibrary& base,
                       const std::string& name = "");

}  // namespace diurna
