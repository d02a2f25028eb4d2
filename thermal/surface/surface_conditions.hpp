#pragma once

#include "materials/matter/material.hpp"
#include "thermal/surface/heat_balance.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// [W m⁻² K⁻¹] between a surface and a small amount of frost or water on it.
inline constexpr double thin_phase_film = 50.0;

/// Conditions above one facet's ground at one instant: a point's surface, with its cover (water,
/// frost, leaves).
struct SurfaceConditions {
    AirFilm air{};
    NaturalFilm natural{};
    double wind_speed = 0.0;      // [m s⁻¹] for the ground under leaves
    double wind_height = 10.0;    // [m]
    double absorbed_solar = 0.0;  // [W m⁻²]
    double longwave_in = 0.0;     // [W m⁻²] irradiance from the sky
    double own_view = 0.0;        // of ground at the facet's own temperature, 0 to 1
    double emissivity = 1.0;
    double internal = 0.0;   // [W m⁻²]
    double wet_share = 0.0;  // covered by water, evaporating freely
    double rain_mm_h = 0.0;
    bool stores = false;  // dew also collects on surfaces that do not evaporate
    /// Heat that melts all frost and freezes all water there within the step [W m⁻²]: the upper
    /// limits of `phase_film` times the difference from 273.15 K.
    double frost_heat = 0.0, water_heat = 0.0;
    double phase_film = thin_phase_film;  // [W m⁻² K⁻¹]
    double snow_conductance = 0.0;        // [W m⁻² K⁻¹] of snow on bare ground; 0: none
    Canopy canopy;
};

/// The terms at a ground temperature, positive towards the surface [W m⁻²].
struct SurfaceTerms {
    HeatBalance balance;       // `conducted` is zero
    double wet_evaporation;    // latent heat of the wet share alone, per unit wet share
    double frost_melt;         // heat used by melting frost (negative) or released by freezing
    double radiometric;        // [K] what a radiometer sees
    double leaf;               // [K] leaves, skin or snow; the ground itself without them
    double into_ground;        // total
    double into_ground_slope;  // d/dT of the ground [W m⁻² K⁻¹]
};

}  // namespace diurna
