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

double air_density(const AirState& air);                // [kg m⁻³], moist
double specific_humidity(const AirState& air);          // [kg kg⁻¹]
double saturation_vapour_pressure(double temperature);  // [Pa] over water (Murray/Magnus; see .cpp)
double saturation_vapour_pressure_derivative(double temperature);  // [Pa K⁻¹]
double latent_heat_of_vaporisation(double temperature);            // [J kg⁻¹]
double dew_point(double vapour_pressure);                          // [K]
/// Pressure [Pa] of the standard atmosphere at a height [m] above the sea.
double standard_pressure(double height);

}  // namespace diurna
