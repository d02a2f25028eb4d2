#pragma once

#include <cstddef>

#include "thermal/column/column.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// The terms of a surface's heat balance, positive towards the surface [W m⁻²].
struct HeatBalance {
    double absorbed_solar = 0.0;
    double longwave_in = 0.0;   // ε L_in, absorbed
    double longwave_out = 0.0;  // −ε σ T⁴
    double sensible = 0.0;
    double latent = 0.0;
    double internal = 0.0;
    double conducted = 0.0;  // from the ground below

    /// Zero for a massless surface; what the surface's own half cell stores otherwise.
    double sum() const;
};

/// Everything but conduction, for one facet.
///
/// absorbed_solar  [W m⁻²]   longwave_in  irradiance, before absorption [W m⁻²]
HeatBalance heat_balance(const AirFilm& air, NaturalFilm natural, double emissivity,
                         double absorbed_solar, double longwave_in, double internal,
                         double temperature);

/// The surface equations of up to `lanes` facets of one material at one instant,
///
///     heat − ε σ T⁴ + sensible(T) + latent(T) + a − b (T − reference) = 0.
struct SurfaceLanes {
    std::size_t count;
    const double* heat;          // absorbed sun, absorbed longwave and internal [W m⁻²]
    const NaturalFilm* natural;  // of plates; unused for ground
    const double* a;             // [W m⁻²] of the column below (thermal/column/column.hpp)
    double b;                    // [W m⁻² K⁻¹]
    double reference;            // [K]
    double emissivity;
    double* temperature;  // in: a guess; out: the root [K]
    double* flux;         // out: everything above the ground at the root [W m⁻²]
    double* slope;        // out: d(flux)/dT there [W m⁻² K⁻¹]
};

struct SurfaceCount {
    int iterations = 0;
    std::size_t bisections = 0;  // lane-iterations in which Newton left the bracket
};

/// Newton within the bracket 1 to 5000 K, all lanes until the last correction is below 1e-5 K
/// (wet 1e-6, plates 1e-8) and has been applied; what is left goes with its square, below 1e-12 K.
/// The equation has one root: every term falls with T but a stable film's tail, which conduction
/// and radiation outweigh.
SurfaceCount solve_surface(const AirFilm& air, const SurfaceLanes& surface);

}  // namespace diurna
