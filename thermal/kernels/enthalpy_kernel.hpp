#pragma once

#include <cstddef>

#include "thermal/column/enthalpy_column.hpp"
#include "thermal/kernels/lane_air.hpp"

namespace diurna {

// An implicit stage of columns with freezing and melting water, and water and snow on the surface,
// in parallel, as plain arrays: arguments of the loops compiled for each vector width
// (thermal/kernels/enthalpy_loops.hpp). Nothing here allocates or throws. All lanes are computed,
// used or not; each has its own air and length of step.

/// Conditions above the columns during a stage [lane].
struct EnthalpySurface {
    const LaneAir* air;
    const NaturalFilm* natural;
    const double* heat;        // [W m⁻²] absorbed sun and longwave, internal
    const double* wet_share;   // covered by water or frost, evaporating freely
    const double* frost_heat;  // [W m⁻²] that melts all frost within the step, and
    const double* water_heat;  // freezes all water
    const double* phase_film;  // [W m⁻² K⁻¹] coupling for melting and freezing
    const double* cover;  // [W m⁻² K⁻¹] of the snow between skin and ground; null: no snow
    const double* least_film;  // [W m⁻² K⁻¹] of snow's skin, else 0
    double emissivity;
    bool evaporates;       // vapour flux in either direction
    const double* behind;  // [W m⁻²] absorbed by a plate's back; null: the column's bottom
    double back_emissivity;
};

/// heat content = target + tau · fluxes, for every node; arrays [node][lane] and [lane].
struct EnthalpyStage {
    const EnthalpyColumn& column;
    const double* tau;            // [s]
    const double* begin;          // state u at the start of the step
    const double* target;         // [J m⁻²] above that
    double* by;                   // in: a guess; out: change of each node
    double* work;                 // memory for three values a node
    double* skin;                 // in: a guess; out: [K] of the surface, above its snow if any
    double *flux, *slope;         // out: into the ground [W m⁻²], and d/dT of the ground
    double *below, *below_slope;  // out: the same at the other end
    double* taken;                // out: [W m⁻²] into the ground, from its own side
    double* solved;               // out: 1, or 0 for lanes that did not converge
};

struct EnthalpyKernel {
    /// Returns the number of sweeps.
    int (*solve)(const EnthalpySurface&, const EnthalpyStage&);
    /// At the skins' temperatures [lane]: latent heat per unit wet share, and that of melting
    /// [W m⁻²].
    void (*store)(const EnthalpySurface&, const double* skin, double* wet_latent, double* melt);
    /// Applies a step to `columns` deviations of its start, [node][column][lane], in
    /// place: one implicit stage of length tau [lane] from e.begin to u, with slopes
    /// e.slope and e.below_slope; lanes with `taken` 0 are unchanged. Single precision, as
    /// for Newton.
    void (*carry)(const EnthalpyStage&, const double* tau, const double* u, const double* taken,
                  std::size_t columns, float* map);
};
extern const EnthalpyKernel enthalpy_avx2, enthalpy_avx512;

/// The kernel of this processor.
const EnthalpyKernel& enthalpy_kernel();

}  // namespace diurna
