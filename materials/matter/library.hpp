#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "materials/base/document.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// The materials a scene may name.
class MaterialLibrary {
 public:
    MaterialLibrary() = default;
    explicit MaterialLibrary(std::vector<Material> materials);

    const Material& operator[](MaterialId id) const;
    std::size_t size() const { return materials_.size(); }
    std::vector<std::string> names() const;
    /// Throws InputError("where", ...) with the nearest name if there is none of that name.
    MaterialId find(const std::string& name, const std::string& where = "material") const;
    /// Adds a material (a scene's own) or replaces the one of that name.
    MaterialId add(Material material);

 private:
    std::vector<Material> materials_;
};

/// TOML is read through materials/base/document.hpp (Section: typed keys, ranges, positions,
/// unknown keys). Reads a library file (TOML): one table per material, spectra as CSV beside it.
/// Broadband albedo (weighted by the sun's spectrum at the ground, ASTM G173 global) and emissivity
/// (weighted by Planck at 300 K) are computed from the spectra. Every mistake carries
/// file:line:column. See materials/library.toml.
MaterialLibrary load_material_library(const std::filesystem::path& file);

/// A material read from a table of any document (library, scene, column file), all with the same
/// keys; see materials/library.toml for them.
///
/// base      what `like = "NAME"` starts from. Without `like`, a table whose `name` is known
///           there starts from that one, so `name = "asphalt"` alone is the library's asphalt and
///           `name = "asphalt", albedo = 0.08` is that asphalt made darker
/// folder    where relative names of spectrum files start
/// name      the material's name where the table has no `name` of its own
///
/// Mistakes are noted in the section's document, which throws them all in finish().
Material read_material(const Section& section, const MaterialLibrary& base,
                       const std::filesystem::path& folder, const std::string& name = "");

/// The library that comes with the program: data_folder() / "library.toml".
MaterialLibrary default_material_library();

/// Broadband means of a spectrum: by the solar spectrum at the ground, and by Planck's law at
/// `temperature` [K].
double solar_mean(const Spectrum& s);
double planck_mean(const Spectrum& s, double temperature = 300.0);

}  // namespace diurna
