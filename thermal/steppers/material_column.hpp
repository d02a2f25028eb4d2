#pragma once

#include "thermal/column/column.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// Shared by all facets of one material: surface, column, and the coefficients of a step.
struct MaterialColumn {
    ThermalSurface surface;
    LouisForm louis;
    ColumnGrid grid;
    Stage stage;
    double reference;  // [K] zero of the states
    int substeps;      // per step of the solve; more than one for thin, quick materials

    double absorptance() const { return 1.0 - surface.albedo - surface.solar_transmittance; }
};

struct StepSetup {
    double step = 600.0;        // [s] of the solve
    double wind_height = 10.0;  // [m]
    double air_height = 2.0;    // [m]
    double reference = 288.15;  // [K]
    /// A step is divided if 25 W m⁻² K⁻¹ moves the surface by more than this share of the final
    /// change: a longer implicit step overshoots after a jump.
    double largest_share = 1.0;
    int most_substeps = 2;  // six are no better in a day of shadows (bench/solver_bench)
    int refinement = 1;     // every (sub)step is divided further by this number
    GridOptions grid;
};
/// `louis`: the surface's film formula if known, which saves half a millisecond.
MaterialColumn material_column(const ThermalSurface& surface, const StepSetup& setup,
                               const LouisForm* louis = nullptr);

}  // namespace diurna
