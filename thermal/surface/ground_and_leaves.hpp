#pragma once

#include "materials/matter/material.hpp"
#include "thermal/column/nonlinear_column.hpp"
#include "thermal/surface/heat_balance.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// What stands above one facet's ground at one instant: a point's surface, with all it may
/// carry (water, frost, leaves).
struct SurfaceConditions {
    AirFilm air{};
    NaturalFilm natural{};
    double wind_speed = 0.0;      // [m s⁻¹] for the ground under leaves
    double wind_height = 10.0;    // [m]
    double absorbed_solar = 0.0;  // [W m⁻²]
    double longwave_in = 0.0;     // [W m⁻²] irradiance from the sky
    double own_view = 0.0;        // of ground as warm as the facet itself, 0 to 1
    double emissivity = 1.0;
    double internal = 0.0;   // [W m⁻²]
    double wet_share = 0.0;  // covered by standing water, evaporating freely
    double rain_mm_h = 0.0;
    bool stores = false;  // dew collects even on what does not evaporate by itself
    /// What melts all frost and freezes all water that lies there within the step [W m⁻²]: they do
    /// so by 50 W m⁻² K⁻¹ from 273.15 K, up to this.
    double frost_heat = 0.0, water_heat = 0.0;
    Canopy canopy;
};

/// The terms at a ground temperature, positive towards the surface [W m⁻²].
struct SurfaceTerms {
    HeatBalance balance;       // `conducted` stays zero
    double wet_evaporation;    // latent heat of the wet share alone, per unit wet share
    double frost_melt;         // heat taken by melting frost (negative), given by freezing water
    double radiometric;        // [K] what a radiometer sees
    double leaf;               // [K] leaves or skin; the ground itself without them
    double into_ground;        // all of it
    double into_ground_slope;  // d/dT of the ground [W m⁻² K⁻¹]
};
SurfaceTerms surface_terms(const SurfaceConditions& conditions, double ground_temperature);

/// Latent heat towards the surface [W m⁻²] and its slope: as `latent_heat`
/// (thermal/surface/turbulence), but over ice below 273.15 K: Murray's (1967) pressure over ice,
/// and the heat of sublimation, blended in over 2 K, so that the balance falls with T throughout.
LatentHeat latent_heat_or_frost(const AirFilm& air, const Film& film, double wetness,
                                double resistance, double temperature);

/// Heat of sublimation of ice [J kg⁻¹], Rogers & Yau 1989: 2834.1 − 0.29 t − 0.004 t² kJ/kg.
double latent_heat_of_sublimation(double temperature);

/// Heat that vapour takes from a surface [J kg⁻¹]: of vaporisation, blended into that of
/// sublimation over the 2 K below melting.
double heat_of_vapour(double air_temperature, double surface_temperature);

/// Air as warm as a surface that moves through it would find it (recovery temperature):
/// T (1 + r (γ − 1)/2 M²) with r = 0.89, turbulent, and γ = 1.4.
double recovery_temperature(double air_temperature, double speed);

}  // namespace diurna
