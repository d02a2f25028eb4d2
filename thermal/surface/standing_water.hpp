#pragma once

#include "materials/matter/material.hpp"
#include "thermal/surface/surface_conditions.hpp"

namespace diurna {

/// Water on the surface [kg m⁻² = mm]: liquid, and hoar or snow.
struct Standing {
    double water = 0.0, frost = 0.0;
};

/// Difference of the two [mm].
double apart(const Standing& a, const Standing& b);

/// Capacity of a surface of some slope [mm].
///
/// Water: depression storage decreases with the slope as S^−0.49, S in per cent (Kidd 1978,
/// Institute of Hydrology report 53), from 1 % on, to a film of at least 0.05 mm; leaves hold the
/// same amount on any slope. Snow: all snowfall below 30°, none above 60°, linear between (EN
/// 1991-1-3, shape coefficient of roofs); at most 1000 mm.
///
/// up_cosine  of the outward normal, −1 to 1
struct StoreCapacity {
    double water_mm = 0.0;
    double caught = 1.0;  // share of the snowfall
    bool any() const { return water_mm > 0.0; }
};
StoreCapacity store_capacity(const WaterStore& store, double up_cosine);

/// Rain on a surface over that on level open ground: it falls vertically, without wind.
///
/// open_above  share of it that reaches the surface from above, 0 to 1
double rain_share(double up_cosine, double open_above);

/// Share of precipitation that falls as snow: all at air temperatures below 0 °C, none above 2 °C,
/// linear between (after US Army Corps of Engineers 1956, Snow Hydrology).
double snow_share(double air_temperature);

/// The albedo of snow after a step (AgeingAlbedo): melting or dry, with the snowfall [kg m⁻²].
double aged_albedo(const AgeingAlbedo& law, double before, bool melting, double fallen,
                   double step);

/// Snow and hoar on a surface. They hide depth / (depth + 5 z0) of it (Douville et al. 1995, Clim.
/// Dyn. 12, 21, eq. 9), at 200 kg m⁻³, and insulate that share by depth / k, k = 0.10 W/mK (Calonne
/// et al. 2011, Geophys. Res. Lett. 38, L23501, at 200 kg m⁻³). They store only the heat of
/// melting: for deep snow that lasts weeks use the material `snow`.
struct SnowCover {
    double share = 0.0;
    double conductance = 0.0;             // [W m⁻² K⁻¹] between skin and ground; 0: no snow
    double phase_film = thin_phase_film;  // [W m⁻² K⁻¹] for melting: forty times this for snow
};
SnowCover snow_cover(double frost, double roughness_length);
/// [W m⁻²] Limit for melting of snow's skin at an instant, without a step.
inline constexpr double melts_at_once = 1e6;

/// The wet share of a surface, mean over a step: x = held over capacity follows
/// dx = (rain − drying min(x, 1)) / capacity.
/// rain, drying  [kg m⁻²] in the step, drying for a completely wet surface
/// rain, drying  [kg m⁻²] in the step, drying as if all were wet
double mean_wet_share(double held, double rain, double drying, double capacity);

/// Assumed rates of a store in a step, until they are known [kg m⁻² s⁻¹]: evaporation of a
/// completely wet surface; melting, or freezing (negative).
struct StoreRates {
    double drying = 0.0, melting = 0.0;
};
StoreRates middle_of(const StoreRates& a, const StoreRates& b);
/// Water and snow on a surface over a step, and precipitation [kg m⁻²].
struct Lying {
    Standing middle{};       // mid-step
    double wet_share = 0.0;  // mean
    double rain = 0.0, snow = 0.0;
};
Lying lying_over(const Standing& begin, const StoreCapacity& capacity, const StoreRates& rates,
                 double rain, double snow, double step);
/// Whether the two differ by less than a thousandth of the capacity.
bool alike(const Lying& a, const Lying& b, const StoreCapacity& capacity);

/// Gains and losses of the water on a surface in a step.
struct StoreFlows {
    double rain = 0.0, snow = 0.0;  // [kg m⁻²] precipitation
    double dew = 0.0, hoar = 0.0;   // [kg m⁻²] condensed and deposited
    double evaporated = 0.0;        // [kg m⁻²] of both together
    double melt = 0.0;    // [J m⁻²] used by melting frost; negative: released by freezing
    double drying = 0.0;  // [kg m⁻²] for a completely wet surface

    StoreRates rates(double step) const;
};

/// A stage of a step: its weight [s], the air and the surface [K], the wet share and the latent
/// fluxes of the balance per unit wet share [W m⁻²].
struct StoreStage {
    double weight, air_temperature, surface, wet_share, wet_latent, frost_melt;
};
void add_stage(const StoreStage& stage, StoreFlows& flows);

/// Water since a start [kg m⁻²].
struct WaterCount {
    double fallen = 0.0, condensed = 0.0, evaporated = 0.0, run_off = 0.0;
    /// Residual of the water balance between the store then and now.
    double open(const Standing& before, const Standing& now) const;
};

/// The store after a step: evaporation takes from water and frost by their shares; snow beyond the
/// slope's capacity, and water beyond the capacity and 0.05 of the snow (its pores), run off.
Standing stored_after(const Standing& before, const StoreFlows& flows,
                      const StoreCapacity& capacity, WaterCount& count);

}  // namespace diurna
