#pragma once

#include <filesystem>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// Reflectance of a material of which only the means are known: `albedo` below 4 µm, 1 − emissivity
/// above, over 0.2 to 100 µm.
Spectrum two_step_reflectance(double albedo, double emissivity);

/// The keys of a material's spectra: from files, from `albedo` and `emissivity` alone, or both:
/// then the files give the shape and the numbers the means. Mistakes are noted.
///
/// folder  where relative names of spectrum files start
/// fresh   the material starts from no other: it needs a file or both numbers
void read_optics(const Section& section, const std::filesystem::path& folder, bool fresh,
                 Material& material);

}  // namespace diurna
