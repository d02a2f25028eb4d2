#pragma once

#include <filesystem>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// Reflectance of a material from its means only: `albedo` below 4 µm, 1 − emissivity above, over
/// 0.2 to 100 µm.
Spectrum two_step_reflectance(double albedo, double emissivity);

/// Throws InputError if a file's spectrum has no wavelength below 20 µm: probably in nm.
void check_micrometres(const Spectrum& s, const std::filesystem::path& file);

/// The keys of a material's spectra: from files, from `albedo` and `emissivity` alone, or from
/// both: then the files give the shape and the numbers the means. Mistakes are noted. If the files
/// omit more than a tenth of the sun at the ground, or end before 12 µm, means that were not given
/// are marked as guesses.
///
/// The means are those near the normal, unless given; without reflectance, transmittance or finish
/// in the section they are unchanged.
///
/// fresh   the material starts from no other material: a file or both numbers are required
void read_optics(const Section& section, bool fresh, Material& material);

}  // namespace diurna
