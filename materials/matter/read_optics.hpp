#pragma once

#include <filesystem>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// Reflectance of a material of which only the means are known: `albedo` below 4 µm, 1 − emissivity
/// above, over 0.2 to 100 µm.
Spectrum two_step_reflectance(double albedo, double emissivity);

/// Throws InputError where a spectrum of a file holds no wavelength below 20 µm: one in nm.
void check_micrometres(const Spectrum& s, const std::filesystem::path& file);

/// The keys of a material's spectra: from files, from `albedo` and `emissivity` alone, or both:
/// then the files give the shape and the numbers the means. Mistakes are noted. Where the files
/// leave out more than a tenth of the sun at the ground, or end short of 12 µm, the means that were
/// not given count as guesses.
///
/// The means are those near the normal, unless given; without reflectance, transmittance or finish
/// in the section they stay what they were.
///
/// fresh   the material starts from no other: it needs a file or both numbers
void read_optics(const Section& section, bool fresh, Material& material);

}  // namespace diurna
