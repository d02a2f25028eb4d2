#pragma once

#include "materials/air/profile.hpp"

namespace diurna {

/// The air above a place where only the air at the ground is known: between the two of the AFGL
/// models SAW, MLW, SAS, MLS and TROP whose temperatures at `height_km` (clamped to 0 to 5) enclose
/// `temperature` [K], the mean of a day or more; the coldest or warmest model outside them.
/// Temperatures are interpolated linearly, pressures and mixing ratios logarithmically, so that the
/// profile changes with the temperature without a step. `name` states both.
///
/// Its clear-sky longwave at the ground, with the surface of the weather (with_surface), is 0.9 to
/// 4.4 % above Dilley and O'Brien's formula at 258 to 298 K and a relative humidity of 60 %
/// (tests/materials/seasonal_profile_test.cpp), 7 to 10 % above it at 30 %, as the models' water
/// aloft stays; that of MLS is 38 % above it at 258 K. At 3000 m it is 6 to 19 % below the formula,
/// which knows no pressure.
Profile seasonal_profile(double height_km, double temperature);

}  // namespace diurna
