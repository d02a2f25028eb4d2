#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "materials/material.hpp"

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

/// TOML is read through materials/document.hpp (Section: typed keys, ranges, positions, unknown
/// keys). Reads a library file (TOML): one table per material, spectra as CSV beside it. Broadband
/// albedo (weighted by the sun's spectrum at the ground, ASTM G173 global) and emissivity (weighted
/// by Planck at 300 K) are computed from the spectra. Every mistake carries file:line:column. See
/// materials/library.toml.
MaterialLibrary load_material_library(const std::filesystem::path& file);

/// Materials defined inside another TOML text (a scene, a column file), with the same keys as in
/// the library: what stands under `key` may be one table `[material]`, an array `[[material]]` or a
/// table of tables `[material.NAME]`. Nothing under `key`: none.
///
/// text    whole text of the file    file_name  for messages: "file:line:column: key"
/// base    materials that `like = "NAME"` starts from; a table with a `name` known there and no
///         `like` starts from that one, so `name = "asphalt"` alone is the library's asphalt
/// folder  where relative names of spectrum files start
///
/// Throws one InputError with every mistake found under `key`.
std::vector<Material> parse_materials(const std::string& text, const std::string& file_name,
                                      const std::string& key, const MaterialLibrary& base,
                                      const std::filesystem::path& folder);

/// The library that comes with the program: data_folder() / "library.toml".
MaterialLibrary default_material_library();

/// Broadband means of a spectrum: by the solar spectrum at the ground, and by Planck's law at
/// `temperature` [K].
double solar_mean(const Spectrum& s);
double planck_mean(const Spectrum& s, double temperature = 300.0);

}  // namespace diurna
