#pragma once

#include <array>

#include "thermal/steppers/enthalpy_lanes.hpp"

namespace diurna {

inline constexpr double no_snow = 1e7;  // [W m⁻² K⁻¹] between a skin without snow and the ground

/// What lies on the surfaces of a batch over a step, and what they are like then.
struct Covered {
    std::array<StoreRates, enthalpy_lanes> rates;
    std::array<Lying, enthalpy_lanes> lying;
    EnthalpyBatch::Met met;
    LaneMask bare;  // nothing lies or falls there
};

/// Before a step: what falls, and the rates of the step before.
Covered begin_lying(const EnthalpyForcing& forcing, const EnthalpyBatch& batch);
/// What lies over the step, its rates being as they are taken to be.
void lie(const EnthalpyBatch& batch, const EnthalpyForcing& forcing, Covered& covered);
/// Takes the rates that the step has found; whether they leave on the surfaces what was taken.
bool settle_rates(const EnthalpyForcing& forcing, const EnthalpyBatch& batch,
                  const std::array<StoreFlows, enthalpy_lanes>& flows, const LaneMask& solved,
                  int attempt, Covered& covered);
/// The snow of a lane's surface after a step: older, or new where none lies.
void age_snow(double step, double skin, const StoreFlows& flows, std::size_t lane,
              EnthalpyBatch& batch);

/// The balance's albedo where none is measured, of a surface as wet and as white.
double albedo_of(const EnthalpyBatch& batch, std::size_t lane, double wet, double cover,
                 double snow);
/// Whether snow on it is cover, not the surface itself.
inline bool snow_lies(const ThermalSurface& surface) { return !surface.snow_albedo.has_value(); }

}  // namespace diurna
