#pragma once

#include "materials/matter/material.hpp"
#include "thermal/surface/surface_conditions.hpp"

namespace diurna {

/// Water on the surface [kg m⁻² = mm]: liquid, and hoar or snow.
struct Standing {
    double water = 0.0, frost = 0.0;
};

/// How much the two differ [mm].
double apart(const Standing& a, const Standing& b);

/// What stays on a surface of some slope [mm].
///
/// Water: depression storage falls with the slope as S^−0.49, S in per cent (Kidd 1978, Institute
/// of Hydrology report 53), from 1 % on, to a film of 0.05 mm at the least; leaves hold as much on
/// any slope. Snow: all of what falls below 30°, none above 60°, straight between (EN 1991-1-3,
/// shape coefficient of roofs); no more than 1000 mm.
///
/// up_cosine  of the outward normal, −1 to 1
struct StoreCapacity {
    double water_mm = 0.0;
    double caught = 1.0;  // share of the snow that falls
    bool any() const { return water_mm > 0.0; }
};
StoreCapacity store_capacity(const WaterStore& store, double up_cosine);

/// Rain on a surface over that on level open ground: it falls straight down, whatever the wind.
///
/// open_above  share of it that nothing above keeps off, 0 to 1
double rain_share(double up_cosine, double open_above);

/// Share of precipitation that falls as snow: all below 0 °C of the air, none above 2 °C, straight
/// between (after US Army Corps of Engineers 1956, Snow Hydrology).
double snow_share(double air_temperature);

/// The albedo of snow after a step (AgeingAlbedo): melting or dry, with what fell [kg m⁻²].
double aged_albedo(const AgeingAlbedo& law, double before, bool melting, double fallen,
                   double step);

/// Snow and hoar that lie on a surface. They hide depth / (depth + 5 z0) of it (Douville et al.
/// 1995, Clim. Dyn. 12, 21, eq. 9), at 200 kg m⁻³, and part it from the air by depth / k of that
/// share, k = 0.10 W/mK (Calonne et al. 2011, Geophys. Res. Lett. 38, L23501, at 200 kg m⁻³). They
/// store no heat but that of melting: what lies deep for weeks is better the material `snow`.
struct SnowCover {
    double share = 0.0;
    double conductance = 0.0;             // [W m⁻² K⁻¹] between skin and ground; 0: none lies
    double phase_film = thin_phase_film;  // [W m⁻² K⁻¹] to what melts: forty times as much of snow
};
SnowCover snow_cover(double frost, double roughness_length);
/// [W m⁻²] What snow's skin may take by melting at a moment, no step being given.
inline constexpr double melts_at_once = 1e6;

/// The wet share of a surface, mean over a step: x = held over capacity follows
/// dx = (rain − drying min(x, 1)) / capacity.
///
/// rain, drying  [kg m⁻²] in the step, drying as if all were wet
double mean_wet_share(double held, double rain, double drying, double capacity);

/// What a step is taken to do to a store, until it is known [kg m⁻² s⁻¹]: evaporate as if all were
/// wet; melt, or freeze (negative).
struct StoreRates {
    double drying = 0.0, melting = 0.0;
};
StoreRates middle_of(const StoreRates& a, const StoreRates& b);
/// What lies on a surface over a step, and what falls [kg m⁻²].
struct Lying {
    Standing middle{};       // half way
    double wet_share = 0.0;  // mean
    double rain = 0.0, snow = 0.0;
};
Lying lying_over(const Standing& begin, const StoreCapacity& capacity, const StoreRates& rates,
                 double rain, double snow, double step);
/// Whether two differ by less than a thousandth of the capacity.
bool alike(const Lying& a, const Lying& b, const StoreCapacity& capacity);

/// What a step brings to the water on a surface and takes from it.
struct StoreFlows {
    double rain = 0.0, snow = 0.0;  // [kg m⁻²] as they fall
    double dew = 0.0, hoar = 0.0;   // [kg m⁻²] condensed and deposited
    double evaporated = 0.0;        // [kg m⁻²] of both together
    double melt = 0.0;    // [J m⁻²] taken by melting frost; negative: given by freezing
    double drying = 0.0;  // [kg m⁻²] as if all were wet

    StoreRates rates(double step) const;
};

/// A stage of a step: what counts of it [s], the air and the surface [K], the wet share and what
/// goes by the balance, per unit wet share [W m⁻²].
struct StoreStage {
    double weight, air_temperature, surface, wet_share, wet_latent, frost_melt;
};
void add_stage(const StoreStage& stage, StoreFlows& flows);

/// Water since some time [kg m⁻²].
struct WaterCount {
    double fallen = 0.0, condensed = 0.0, evaporated = 0.0, run_off = 0.0;
    /// What the count leaves unexplained of what lies there now and did at its beginning.
    double open(const Standing& before, const Standing& now) const;
};

/// The store after a step: evaporation takes from water and frost by their shares; snow beyond what
/// its slope catches, and water beyond the capacity and 0.05 of the snow (its pores), run off.
Standing stored_after(const Standing& before, const StoreFlows& flows,
                      const StoreCapacity& capacity, WaterCount& count);

}  // namespace diurna
