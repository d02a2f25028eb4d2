#pragma once

#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// Latent heat towards the surface [W m⁻²] and its slope: as `latent_heat`
/// (thermal/surface/turbulence), but over ice below 273.15 K: Murray's (1967) pressure over ice,
/// and the heat of sublimation, blended over 2 K, so that the balance decreases with T everywhere.
LatentHeat latent_heat_or_frost(const AirFilm& air, const Film& film, double wetness,
                                double resistance, double temperature);

/// Heat of sublimation of ice [J kg⁻¹], Rogers & Yau 1989: 2834.1 − 0.29 t − 0.004 t² kJ/kg.
double latent_heat_of_sublimation(double temperature);

/// Heat of sublimation over that of vaporisation, at the air's temperature.
double ice_over_water(double air_temperature);

/// Heat carried by vapour from a surface [J kg⁻¹]: of vaporisation, blended into that of
/// sublimation over the 2 K below melting.
double heat_of_vapour(double air_temperature, double surface_temperature);

}  // namespace diurna
