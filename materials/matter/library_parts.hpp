#pragma once

#include <string>
#include <utility>
#include <vector>

#include "materials/base/document.hpp"

namespace diurna {

/// The tables of a document that hold materials: [material.NAME] of a scene, or the one [material]
/// of a column file.
enum class MaterialTables { by_name, one };

/// Replaces values, as Document::set() does, in this order. A key path into a material that the
/// file takes from the library changes that part of it: `material.grass.layers.1.saturation=0.3`
/// copies the layers of the library's grass into the document first. Likewise for every table of a
/// material (`evaporation`, `bottom`, `finish`, ...) and for materials that it is `like`.
///
/// Throws InputError for a material that neither file nor library has, with the nearest name.
void apply_settings(Document& document, const std::vector<std::string>& settings,
                    MaterialTables tables);

/// A value's present path, and the path it is moved to.
using ValueMove = std::pair<std::string, std::string>;

/// The same for values of the document, as Document::move_value() does: of sweeps.
void move_values(Document& document, const std::vector<ValueMove>& moves, MaterialTables tables);

}  // namespace diurna
