#pragma once

#include <filesystem>

#include "materials/base/document.hpp"
#include "materials/matter/library.hpp"

namespace diurna {

/// Reads a library file (TOML): one table per material, spectra as CSV beside it; scenes/KEYS.md
/// lists the keys. Broadband albedo (weighted by the sun's spectrum at the ground, ASTM G173
/// global) and emissivity (weighted by Planck at 300 K) are computed from the spectra. Every
/// mistake carries file:line:column. See materials/library.toml.
MaterialLibrary load_material_library(const std::filesystem::path& file);
/// The same for a document, for which it calls finish().
MaterialLibrary read_material_library(const Document& document);

/// The library delivered with the program: data_folder() / "library.toml". Read once.
MaterialLibrary default_material_library();

}  // namespace diurna
