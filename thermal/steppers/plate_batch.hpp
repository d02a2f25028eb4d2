#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "thermal/column/plate_column.hpp"
#include "thermal/steppers/mode_forcing.hpp"
#include "thermal/steppers/step_record.hpp"

namespace diurna {

// Thin plates with two faces (ThermalSurface::back), stepped exactly except for their films'
// nonlinearity: the counterpart of thermal/steppers/mode_batch.hpp.

/// Up to `lanes` plates of one material in parallel, under one air (ModeForcing's `low`).
struct PlateBatch {
    std::size_t count = 0;
    std::vector<double> state;  // [mode][lane]
    // [face][lane]
    std::array<std::array<double, lanes>, 2> temperature{};  // [K]
    std::array<std::array<double, lanes>, 2> drive{};        // u [W m⁻²]
    std::array<std::array<double, lanes>, 2> slope{};        // d(flux)/dT [W m⁻² K⁻¹]
    std::array<NaturalFilm, lanes> natural{};                // of the front
    std::array<int, lanes> unsettled{};  // further steps to be split after a jump
    /// [lane] absorbed sun and longwave of the backs at the start and the end of a step [W m⁻²];
    /// null: that of surroundings at the air's temperature.
    const double *behind_before = nullptr, *behind = nullptr;
    std::span<const HeatJump> behind_jumps{};  // its jumps within the step
    bool wet_behind = false;                   // the backs evaporate as the fronts do

    void resize(std::size_t modes, std::size_t plates);
};

/// Sets temperatures and drives from the state, under the heat [lane] on the front at the start.
void begin_plates(const PlateStep& step, const ThermalSurface& surface, const AirFilm& air,
                  const double* heat, PlateBatch& batch);

/// One step; for plates with a jump of heat, in front or behind, it is divided: to the jump, then
/// in parts of growing length, as are the two steps after that: sheet steel responds over minutes.
/// `record.slope` gets the sums over plates of d(flux)/dT at its end, front and back;
/// worst_closure the difference between the faces' heat input and the modes', over the sum of its
/// terms.
void advance_plates(const PlateStep& step, const ThermalSurface& surface,
                    const ModeForcing& forcing, PlateBatch& batch, StepRecord& record);

}  // namespace diurna
