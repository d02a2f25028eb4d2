#pragma once

#include "materials/air/profile.hpp"

namespace diurna {

/// The air above a place of which only the air at the ground is known: between those two of the
/// AFGL models SAW, MLW, SAS, MLS and TROP whose temperatures at `height_km` (0 to 5; beyond, as at
/// the ends) enclose `temperature` [K], the mean of a day or more; colder or warmer than all, the
/// coldest or warmest. Temperatures are linear between the two, pressures and mixing ratios
/// logarithmic, so that the profile follows the temperature without a step. `name` states both.
///
/// Its clear-sky longwave at the ground, with the surface of the weather (with_surface), is 0.9 to
/// 4.4 % above Dilley and O'Brien's formula at 258 to 298 K and a relative humidity of 60 %
/// (tests/materials/seasonal_profile_test.cpp); that of MLS is 38 % above it at 258 K.
Profile seasonal_profile(double height_km, double temperature);

}  // namespace diurna
