#pragma once

#include <array>

#include "thermal/steppers/enthalpy_lanes.hpp"

namespace diurna {

inline constexpr double no_snow = 1e7;  // [W m⁻² K⁻¹] between a skin without snow and the ground

/// Water and snow on the surfaces of a batch over a step, and the resulting surface properties.
struct Covered {
    std::array<StoreRates, enthalpy_lanes> rates;
    std::array<Lying, enthalpy_lanes> lying;
    EnthalpyBatch::Met met;
    LaneMask bare;  // without water, snow and precipitation
};

/// Before a step: precipitation, and the rates of the previous step.
Covered begin_lying(const EnthalpyForcing& forcing, const EnthalpyBatch& batch);
/// Water and snow over the step for assumed rates.
void lie(const EnthalpyBatch& batch, const EnthalpyForcing& forcing, Covered& covered);
/// Takes the rates computed by the step; returns whether they agree with the assumed ones.
bool settle_rates(const EnthalpyForcing& forcing, const EnthalpyBatch& batch,
                  const std::array<StoreFlows, enthalpy_lanes>& flows, const LaneMask& solved,
                  int attempt, Covered& covered);
/// Ages the snow of a lane's surface by a step; new if none lies.
void age_snow(double step, double skin, const StoreFlows& flows, std::size_t lane,
              EnthalpyBatch& batch);

/// The albedo for the balance if none is measured, of a surface this wet and this snow-covered.
double albedo_of(const EnthalpyBatch& batch, std::size_t lane, double wet, double cover,
                 double snow);
/// Whether snow on it is a cover, not the surface itself.
inline bool snow_lies(const ThermalSurface& surface) { return !surface.snow_albedo.has_value(); }

}  // namespace diurna
