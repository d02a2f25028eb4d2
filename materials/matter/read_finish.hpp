#pragma once

#include <filesystem>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// The keys of a material that say how light is sent back and let through; mistakes are noted.
///
/// - finish: one of
///     - { kind = "lambert" }
///     - { kind = "gloss", roughness, index }: paint, varnish, glass, water; in place of index
///       index_file, a CSV file of wavelength_um, n and k
///     - { kind = "metal", roughness }, by Schlick's law, or with an index_file by its index
///     - either with effective_index = true: the index that sends back the reflectance upright
///     - { kind = "by_angle", factors = [[angle_deg, factor], ...] }
///     - { kind = "measured", file }: a BRDF (materials/matter/read_brdf.hpp)
/// - see_through: true where rays go on behind it, as far as its transmittance lets them
/// - cover: 0 to 1, of a net: this share is the material and the rest is open
///
/// To be read after reflectance, transmittance and the means that follow from them. With a finish
/// that is not Lambert's the broadband emissivity becomes the hemisphere's, unless it was given.
void read_finish(const Section& section, const std::filesystem::path& folder, Material& material);

}  // namespace diurna
