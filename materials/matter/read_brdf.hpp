#pragma once

#include <filesystem>

#include "materials/matter/measured_brdf.hpp"

namespace diurna {

/// A measured BRDF of a file; its end says which kind:
///
/// .binary  of the MERL database (Matusik et al. 2003): three 32-bit integers 90, 90, 180, then
///          doubles (colour, half vector, difference, azimuth), the half vector's angles as
///          squares; the colours' mean is taken, what was not measured (negative) counts as nothing
/// .csv     light_deg, eye_deg, azimuth_deg, brdf_sr: every combination of the angles once, in any
///          order; azimuth 0 where the eye is on the light's side, 180 where the mirror is
///
/// Throws InputError where a table is not complete, is not reciprocal (f changes by more than a
/// tenth, and a hundredth of its mean, as light and eye change places; MERL's cannot but be) or
/// sends back more than 1.01 of the light up to 75°.
MeasuredBrdf read_brdf(const std::filesystem::path& path);

}  // namespace diurna
