#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "thermal/column/reduced_column.hpp"
#include "thermal/kernels/mode_kernel.hpp"
#include "thermal/steppers/mode_forcing.hpp"
#include "thermal/steppers/step_record.hpp"

namespace diurna {

/// A step of a closed column, exact for a drive u that is linear in time between the step's ends:
///
///     x₁ = decay x₀ + from (u₀ + f) + to (u₁ + f),    θ = Σ surface x,   f the flux from below.
///
/// The drive u = q + film θ includes the surface's whole heat input except through the
/// film. The only error is due to the difference between the true film and this one:
/// second order in the step, and a jump decays for any step (L-stable for any positive
/// true film).
struct ModeStep {
    double step, film, reference, flux_below;            // [s], [W m⁻² K⁻¹], [K], [W m⁻²]
    double response;                                     // Σ surface · to [K m² W⁻¹]
    std::vector<double> rate, surface, decay, from, to;  // (mode)
    std::vector<double> carry;                           // (mode) decay · to + from
    bool quick = false;                                  // ModeCoefficients::quick

    std::size_t modes() const { return rate.size(); }
    ModeCoefficients coefficients(double emissivity) const;
};
ModeStep make_mode_step(const ReducedColumn& column, const ClosedColumn& closed, double step);

/// Up to `mode_lanes` facets of one material in units of `lanes`; unused lanes of the last unit
/// repeat its first lane.
struct ModeBatch {
    std::size_t count = 0;
    std::vector<double> state;  // [unit][mode][lane of the unit]
    // [lane]
    std::array<double, mode_lanes> temperature{};  // of the surface [K]
    std::array<double, mode_lanes> drive{};        // u + f [W m⁻²]
    std::array<double, mode_lanes> slope{};        // d(flux)/dT of the surface [W m⁻² K⁻¹]
    std::array<NaturalFilm, mode_lanes> natural{};
    std::vector<std::size_t> unsettled;  // lanes to be split once more after a jump

    void resize(std::size_t modes, std::size_t facets);
    std::size_t units() const { return (count + lanes - 1) / lanes; }
};

/// Sets temperature and drive from the state.
void begin_modes(const ModeStep& step, const AirOver& air, const double* heat, double emissivity,
                 ModeBatch& batch);

/// One step. Lanes with a jump of heat, and on fast surfaces also those that had one in the step
/// before, are stepped separately: to the jump, then in four parts of growing length.
/// `record.slope[0]` receives the sum over lanes of d(flux)/dT at its end; worst_closure the
/// difference between the surface's heat input at the step's end and the modes', over the sum of
/// its terms. The modes themselves conserve energy exactly (tests/thermal/reduced_column_test).
///
/// Between begin_modes and end_modes the state lacks the last drive's own part.
void advance_modes(const ModeStep& step, const ModeForcing& forcing, double emissivity,
                   ModeBatch& batch, StepRecord& record);
void end_modes(const ModeStep& step, ModeBatch& batch);

}  // namespace diurna
