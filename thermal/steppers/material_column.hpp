#pragma once

#include "thermal/column/column.hpp"
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

}  // namespace diurna
