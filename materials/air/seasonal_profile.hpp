#pragma once

#include "materials/air/profile.hpp"

namespace diurna {

/// The air above a place of which only the air at the ground is known: between those two of the
/// AFGL models SAW, MLW, SAS, MLS and TROP whose temperatures at `height_km` (0 to 5; beyond, as at
/// the ends) enclose `temperature` [K], the mean of a day or more; colder or warmer than all, the
/// coldest or warmest. Temperatures are linear between the two, pressures and mixing ratios
/// logarithmic, so that the profile follows the temperature without a step. `name` states both.
///
/// Its clear-sky longwave at the ground, with the surface of the weather (with_surface), is within
/// 7 W/m² of Dilley and O'Brien's formula at 265 to 298 K (tests/materials/seasonal_profile_test.cpp);
/// MLS at all temperatures is 56 W/m² too much at 265 K.
Profile seasonal_profile(double height_km, double temperature);

}  // namespace diurna
