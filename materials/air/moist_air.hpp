#pragma once

namespace diurna {

/// The air near the ground.
struct AirState {
    double temperature = 288.15;    // [K]
    double pressure = 101325.0;     // [Pa]
    double vapour_pressure = 1000;  // [Pa]
};

inline constexpr double dry_air_heat_capacity = 1005.0;  // cp [J kg⁻¹ K⁻¹]
inline constexpr double dry_air_gas_constant = 287.05;   // [J kg⁻¹ K⁻¹]
inline constexpr double water_over_dry_air = 0.62198;    // molar masses, 18.01528 / 28.9647

double air_density(const AirState& air);  // [kg m⁻³], moist
/// Saturation vapour pressure over water [Pa], by std::exp (saturation.hpp)
double saturation_vapour_pressure(double temperature);
double latent_heat_of_vaporisation(double temperature);  // [J kg⁻¹]
/// Pressure [Pa] of the standard atmosphere at a height [m] above the sea.
double standard_pressure(double height);

}  // namespace diurna
