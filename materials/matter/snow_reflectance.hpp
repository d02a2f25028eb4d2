#pragma once

#include "materials/radiation/spectrum.hpp"

namespace diurna {

/// Spectral reflectance of snow whose mean under the sun at the ground is `albedo`, 0 to 1.
///
/// Interpolated linearly between the two of the library's snow_fine, snow_medium and snow_coarse
/// (grains of 0.05, 0.2, 1 mm; Wiscombe and Warren 1980; albedo 0.84, 0.78, 0.68) that enclose
/// it: grains grow as snow ages. Snow darker than the coarse one (with dirt: Warren & Wiscombe
/// 1980) or brighter than the fine one is moved in sunlight towards black or white as in
/// with_albedo().
Spectrum snow_reflectance(double albedo);

/// (1 − share) a + share b, on the points of both; outside its range each counts as its end.
Spectrum mixed_spectrum(const Spectrum& a, const Spectrum& b, double share);

}  // namespace diurna
