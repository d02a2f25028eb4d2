#pragma once

#include "materials/radiation/spectrum.hpp"

namespace diurna {

/// Spectral reflectance of snow whose mean under the sun at the ground is `albedo`, 0 to 1.
///
/// Between the library's snow_fine, snow_medium and snow_coarse (grains of 0.05, 0.2, 1 mm;
/// Wiscombe and Warren 1980; albedo 0.84, 0.78, 0.68) on the straight line of the two that enclose
/// it: grains grow as snow ages. Darker than the coarse, whose dirt then reports (Warren & Wiscombe
/// 1980), or brighter than the fine, it is moved in sunlight towards black or white as
/// with_albedo() does.
Spectrum snow_reflectance(double albedo);

/// (1 − share) a + share b, on the points of both; where one has no value it counts as its end.
Spectrum mixed_spectrum(const Spectrum& a, const Spectrum& b, double share);

}  // namespace diurna
