#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "thermal/column/column.hpp"
#include "thermal/surface/heat_balance.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// What all facets of one material share: surface, column, and the coefficients of a step.
struct MaterialColumn {
    ThermalSurface surface;
    LouisForm louis;
    ColumnGrid grid;
    Stage stage;
    double reference;  // [K] states are kept relative to it
    int substeps;      // per step of the solve; more than one for thin, quick materials

    double absorptance() const { return 1.0 - surface.albedo - surface.solar_transmittance; }
};

struct StepSetup {
    double step = 600.0;        // [s] of the solve
    double wind_height = 10.0;  // [m]
    double air_height = 2.0;    // [m]
    double reference = 288.15;  // [K]
    /// A step is divided while 25 W m⁻² K⁻¹ moves the surface by more than this share of what it
    /// would move it in the end: an implicit step that reaches too far overshoots after a jump.
    double largest_share = 1.0;
    int most_substeps = 2;  // six would be no better in a day of shadows (bench/solver_bench)
    int refinement = 1;     // every (sub)step is divided once more into so many
    GridOptions grid;
};
/// `louis`: the surface's form if it is known, which saves half a millisecond.
MaterialColumn material_column(const ThermalSurface& surface, const StepSetup& setup,
                               const LouisForm* louis = nullptr);

/// Up to `lanes` columns of one material: temperatures relative to the reference, [node][lane].
struct Batch {
    std::size_t count = 0;
    std::vector<double> state;                // [node][lane]
    std::array<double, lanes> temperature{};  // of the surface [K]
    std::array<double, lanes> rate{};         // its change over the last step, for a first guess
    std::array<NaturalFilm, lanes> natural{};

    void resize(std::size_t nodes, std::size_t facets);
};

/// What a step leaves besides the state.
struct StepRecord {
    double worst_closure = 0.0;  // |stored − in| / Σ|terms| dt, so far
    long long stages = 0, iterations = 0;
    int worst_iterations = 0;
    std::size_t bisections = 0;
    std::array<double, 2> slope{};  // Σ over lanes of d(flux)/dT at the last step's two stages

    void merge(const StepRecord& other);
};

/// Advances a batch by one (sub)step: two implicit stages, each with its own air and heat (absorbed
/// sun and longwave, internal) [lane] [W m⁻²], at step · γ and at the step's end.
void advance(const MaterialColumn& material, const std::array<AirFilm, 2>& air,
             const std::array<const double*, 2>& heat, Batch& batch, StepRecord& record);

/// The same for a thin plate with air behind (ThermalSurface::back): its last node exchanges heat
/// with air and surroundings of the air's temperature, through the film of its other side and
/// radiation, solved by Newton around the surface's own to 1e-9 K. `advance` calls it.
void advance_plate(const MaterialColumn& material, const std::array<AirFilm, 2>& air,
                   const std::array<const double*, 2>& heat, Batch& batch, StepRecord& record);

/// The steady state under constant air and heat, as a first guess. Returns −Σ over lanes of the
/// surface's slope there [W m⁻² K⁻¹].
double settle(const MaterialColumn& material, const AirFilm& air, const double* heat, Batch& batch);

}  // namespace diurna
