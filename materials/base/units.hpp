#pragma once

#include <cmath>
#include <numbers>

/// Constants (CODATA 2018, exact since the 2019 SI) and conversions at the edges of the program.
namespace diurna {

inline constexpr double stefan_boltzmann = 5.670374419184429e-8;  // [W m⁻² K⁻⁴]
inline constexpr double first_radiation_um = 119104297.2397188;   // 2hc² [W µm⁴ m⁻² sr⁻¹]
inline constexpr double second_radiation_um = 14387.76877503934;  // hc/k [µm K]
inline constexpr double gravity = 9.80665;                        // [m s⁻²]
inline constexpr double von_karman = 0.4;
inline constexpr double solar_constant = 1361.0;  // [W m⁻²] at 1 AU, TSI of Kopp & Lean 2011
inline constexpr double zero_celsius = 273.15;    // [K]

constexpr double radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / std::numbers::pi); }
constexpr double kelvin(double celsius) { return celsius + zero_celsius; }
constexpr double celsius(double kelvin) { return kelvin - zero_celsius; }
constexpr double um_of_wavenumber(double per_cm) { return 1e4 / per_cm; }
constexpr double wavenumber_of_um(double um) { return 1e4 / um; }
inline double power4(double x) { return (x * x) * (x * x); }

}  // namespace diurna
