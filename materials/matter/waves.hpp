#pragma once

#include "materials/matter/material.hpp"

namespace diurna {

/// Mean square slope of water under a wind, σ² = 0.003 + 0.00512 U, sum of both directions (Cox &
/// Munk 1954, J. Opt. Soc. Am. 44, 838; clean surface, 1 to 14 m/s).
///
/// - wind_speed: [m s⁻¹] 12.5 m above the water
double mean_square_slope(double wind_speed);
/// The wind used for hemispherical means of water, in heat balance and exchange: at 0.5 and 10 m/s
/// its emissivity differs by at most 0.008 (tests/materials/waves_test.cpp).
inline constexpr double mean_wind_over_water = 3.0;
/// Converts a wind at another height to 12.5 m above water: log profile, roughness length 0.2 mm.
double wind_over_water(double wind_speed, double height);

/// The α of a finish's microfacets: for water from the wind, else its own; 0 without microfacets.
double roughness_under(const Finish& finish, double wind_speed);
/// The material under a wind.
Material under_wind(const Material& material, double wind_speed);

}  // namespace diurna
