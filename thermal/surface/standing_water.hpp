#pragma once

#include <array>

#include "thermal/surface/surface_conditions.hpp"

namespace diurna {

/// Water on the surface [kg m⁻² = mm].
struct Standing {
    double water = 0.0, frost = 0.0;
};

/// How much the two differ [mm].
double apart(const Standing& a, const Standing& b);

/// Share of precipitation that falls as snow: all below 0 °C of the air, none above 2 °C, straight
/// between (after US Army Corps of Engineers 1956, Snow Hydrology).
double snow_share(double air_temperature);

/// The albedo of snow after a step (AgeingAlbedo): melting or dry, with what fell [kg m⁻²].
double aged_albedo(const AgeingAlbedo& law, double before, bool melting, double fallen,
                   double step);

/// What a step brings to the water on a surface and takes from it.
struct StoreFlows {
    double rain = 0.0, snow = 0.0;  // [kg m⁻²] as they fall
    double dew = 0.0, hoar = 0.0;   // [kg m⁻²] condensed and deposited
    double evaporated = 0.0;        // [kg m⁻²] of both together
    double melt = 0.0;  // [J m⁻²] taken by melting frost; negative: given by freezing
    double free = 0.0;  // [W m⁻²] latent heat, mean, per unit wet share

    double gained() const { return rain + snow + dew + hoar; }
};

/// From the surface's temperatures at the two stages of a step (the second alone, `gentle`).
StoreFlows store_flows(const std::array<SurfaceConditions, 2>& conditions,
                       const std::array<double, 2>& surface, bool gentle, double step);

/// The store after them: evaporation takes from water and frost by their shares; what is more than
/// `capacity_mm` runs off, or lies as snow that this surface is not.
Standing stored_after(const Standing& before, const StoreFlows& flows, double capacity_mm);

}  // namespace diurna
