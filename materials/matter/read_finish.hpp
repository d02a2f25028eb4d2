#pragma once

#include <filesystem>
#include <optional>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// The key of a material for its angular reflectance; mistakes are noted.
///
/// - finish: one of
///     - { kind = "lambert" }
///     - { kind = "gloss", roughness, index }: paint, varnish, glass, water; or index_file,
///       a CSV file of wavelength_um, n and k, instead of index
///     - { kind = "metal", roughness }, by Schlick's law, or with an index_file by its index
///     - both: effective_index = true takes the index that gives the reflectance at 0°
///     - { kind = "by_angle", factors = [[angle_deg, factor], ...] }
///     - { kind = "measured", file }: a BRDF (materials/matter/read_brdf.hpp)
///
/// To be read after reflectance, transmittance and the means computed from them, which for a net
/// are those of its strips. With a finish other than Lambert the broadband emissivity becomes the
/// hemispherical one, unless it was given.
///
/// renewed  whether those means come from new spectra or a new finish; otherwise they stay the
///          hemispherical ones
void read_finish(const Section& section, bool renewed, Material& material);

/// Description of a material's `finish`.
inline constexpr const char* finish_says = "reflectance as a function of angle";

/// Wavelengths of n and k in a material's index_file; its ends are continued beyond.
struct IndexReach {
    double from_um, to_um;
    double needed_to_um;   // start of another law; 1e3: no other law
    bool effective_helps;  // of a gloss
};
/// Of a material that was read before as `finish`; nothing without such a file, or if its index is
/// not used.
std::optional<IndexReach> index_reach(const Section& section, const Glossy& finish);

}  // namespace diurna
