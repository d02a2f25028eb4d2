#pragma once

namespace diurna {

/// Viscosity and thermal conductivity of dry air, independent of pressure (U.S. Standard Atmosphere
/// 1976, equations 51 and 53): Sutherland's law and its counterpart for heat.
///
/// temperature  [K] 100 to 3000
double air_viscosity(double temperature);     // dynamic [kg m⁻¹ s⁻¹]; 1.716e-5 at 273.15 K
double air_conductivity(double temperature);  // [W m⁻¹ K⁻¹]; 0.0243 there

}  // namespace diurna
