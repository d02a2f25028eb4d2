#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "thermal/column/plate_column.hpp"
#include "thermal/steppers/mode_forcing.hpp"
#include "thermal/steppers/step_record.hpp"

namespace diurna {

// Thin plates with two faces (ThermalSurface::back), stepped exactly but for their films'
// curvature: what thermal/steppers/mode_batch.hpp is for ground.

/// Up to `lanes` plates of one material side by side, under one air (ModeForcing's `low`).
struct PlateBatch {
    std::size_t count = 0;
    std::vector<double> state;  // [mode][lane]
    // [face][lane]
    std::array<std::array<double, lanes>, 2> temperature{};  // [K]
    std::array<std::array<double, lanes>, 2> drive{};        // u [W m⁻²]
    std::array<std::array<double, lanes>, 2> slope{};        // d(flux)/dT [W m⁻² K⁻¹]
    std::array<NaturalFilm, lanes> natural{};                // of the front
    std::array<int, lanes> unsettled{};  // steps that still go in parts after a jump
    /// [lane] absorbed sun and longwave of the backs at the start and the end of a step [W m⁻²];
    /// null: that of surroundings as warm as the air.
    const double *behind_before = nullptr, *behind = nullptr;
    std::span<const HeatJump> behind_jumps{};  // of it, within the step
    bool wet_behind = false;                   // the backs evaporate as the fronts do

    void resize(std::size_t modes, std::size_t plates);
};

/// Sets temperatures and drives from the state, under the heat [lane] on the front at the start.
void begin_plates(const PlateStep& step, const ThermalSurface& surface, const AirFilm& air,
                  const double* heat, PlateBatch& batch);

/// One step; plates whose heat jumps, in front or behind, go to the jump and from there in parts of
/// growing length, the two steps after that likewise: sheet steel takes minutes to follow.
/// `record.slope` gets the sums over plates of d(flux)/dT at its end, front and back; worst_closure
/// what the faces take in less what the modes got, over the sum of its terms.
void advance_plates(const PlateStep& step, const ThermalSurface& surface,
                    const ModeForcing& forcing, PlateBatch& batch, StepRecord& record);

}  // namespace diurna
