#pragma once

#include <filesystem>

#include "materials/matter/measured_brdf.hpp"

namespace diurna {

/// Reads a measured BRDF from a file; the file's extension determines its format:
///
/// .binary  of the MERL database (Matusik et al. 2003): three 32-bit integers 90, 90, 180, then
///          doubles (colour, half vector, difference, azimuth), the half vector's angles as
///          squares; the mean over colours is used, unmeasured (negative) values count as zero
/// .csv     light_deg, eye_deg, azimuth_deg, brdf_sr: every combination of the angles once, in any
///          order; azimuth 0 where the eye is on the light's side, 180 at the mirror direction
///
/// Throws InputError if a table is incomplete, is not reciprocal (f changes by more than a tenth,
/// and a hundredth of its mean, when light and eye are exchanged; MERL's is reciprocal by its
/// format) or reflects more than 1.01 of the light up to 75°.
MeasuredBrdf read_brdf(const std::filesystem::path& path);

}  // namespace diurna
