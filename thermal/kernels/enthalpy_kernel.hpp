#pragma once

#include <cstddef>

#include "thermal/column/enthalpy_column.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

// An implicit stage of columns whose water freezes and melts and on which water and snow lie, side
// by side, as plain arrays: what the loops compiled for each width of vectors take
// (thermal/kernels/enthalpy_loops.hpp). Nothing here allocates or throws. All lanes are computed,
// used or not.

inline constexpr std::size_t enthalpy_lanes = 8;

/// What stands above the columns during a stage [lane].
struct EnthalpySurface {
    AirFilm air;
    const NaturalFilm* natural;
    const double* heat;        // [W m⁻²] absorbed sun and longwave, internal
    const double* wet_share;   // covered by water or frost, evaporating freely
    const double* frost_heat;  // [W m⁻²] that melts all frost within the step, and
    const double* water_heat;  // freezes all water
    const double* phase_film;  // [W m⁻² K⁻¹] to what melts and freezes
    const double* cover;  // [W m⁻² K⁻¹] of the snow between skin and ground; null: none lies
    const double* least_film;  // [W m⁻² K⁻¹] of snow's skin, else 0
    double emissivity;
    bool evaporates;       // vapour goes either way
    const double* behind;  // [W m⁻²] absorbed by a plate's back; null: the column's own bottom
    double back_emissivity;
};

/// heat content = target + tau · fluxes, for every node; arrays [node][lane] and [lane].
struct EnthalpyStage {
    const EnthalpyColumn& column;
    double tau;                   // [s]
    const double* begin;          // state u that the step sets out from
    const double* target;         // [J m⁻²] above that
    double* by;                   // in: a guess; out: how far each node has come
    double* work;                 // memory for three values a node
    double* skin;                 // in: a guess; out: [K] of the surface, over its snow if any lies
    double *flux, *slope;         // out: into the ground [W m⁻²], and d/dT of the ground
    double *below, *below_slope;  // out: the same at the other end
    double* taken;                // out: [W m⁻²] by the ground, from its own side
};

struct EnthalpyCount {
    bool solved = true;
    int passes = 0, iterations = 0;
};

struct EnthalpyKernel {
    EnthalpyCount (*solve)(const EnthalpySurface&, const EnthalpyStage&);
    /// At the skins' temperatures [lane]: latent heat per unit wet share, and that of melting
    /// [W m⁻²].
    void (*store)(const EnthalpySurface&, const double* skin, double* wet_latent, double* melt);
    /// The linearised stage, (heat slope / tau + fluxes' slopes) right, solved for `columns`
    /// right-hand sides [node][column][lane], in place. u: where the stage has led.
    void (*carry)(const EnthalpyStage&, const double* u, std::size_t columns, double* right);
};
extern const EnthalpyKernel enthalpy_avx2, enthalpy_avx512;

/// That of this processor.
const EnthalpyKernel& enthalpy_kernel();

}  // namespace diurna
