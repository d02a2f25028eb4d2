#pragma once

#include "materials/matter/material.hpp"

namespace diurna {

/// Mean square slope of water under a wind, σ² = 0.003 + 0.00512 U, both directions together (Cox &
/// Munk 1954, J. Opt. Soc. Am. 44, 838; clean surface, 1 to 14 m/s).
///
/// - wind_speed: [m s⁻¹] 12.5 m above it
double mean_square_slope(double wind_speed);
/// The wind at which hemispherical means of water are taken, for heat balance and exchange: at 0.5
/// and 10 m/s its emissivity is within 0.008 of that (tests/materials/waves_test.cpp).
inline constexpr double mean_wind_over_water = 3.0;
/// A wind measured at another height, as 12.5 m above water: logarithmic, roughness length 0.2 mm.
double wind_over_water(double wind_speed, double height);

/// The α of a finish's microfacets under a wind: of water the wind's, else its own; 0 without any.
double roughness_under(const Finish& finish, double wind_speed);
/// The material as a wind makes it.
Material under_wind(const Material& material, double wind_speed);

}  // namespace diurna
