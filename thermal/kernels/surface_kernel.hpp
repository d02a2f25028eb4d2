#pragma once

#include <cstddef>

#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// The surface equations of up to `lanes` facets of one material at one instant,
///
///     heat − ε σ T⁴ + sensible(T) + latent(T) + a − b (T − reference) = 0.
struct SurfaceLanes {
    std::size_t count;
    const double* heat;          // absorbed sun, absorbed longwave and internal [W m⁻²]
    const NaturalFilm* natural;  // of plates; not used for ground
    const double* a;             // [W m⁻²] of the column below (thermal/column/column.hpp)
    double b;                    // [W m⁻² K⁻¹]
    double reference;            // [K]
    double emissivity;
    double* temperature;  // in: a guess; out: the root [K]
    double* flux;         // out: net flux at the root, without the column [W m⁻²]
    double* slope;        // out: d(flux)/dT there [W m⁻² K⁻¹]
};

struct SurfaceCount {
    int iterations = 0;
    std::size_t bisections = 0;  // lane-iterations with Newton outside the bracket
};

/// Newton within the bracket 1 to 5000 K, all lanes until the last correction is below 1e-5 K (wet
/// 1e-6, plates 1e-8) and has been applied; the error is of second order, below 1e-12 K. The
/// equation has one root: every term decreases with T except for a stable film's tail, which is
/// smaller than conduction and radiation.
SurfaceCount solve_surface(const AirFilm& air, const SurfaceLanes& surface);

/// Functions for one vector width.
struct SurfaceKernel {
    SurfaceCount (*solve)(const AirFilm&, const SurfaceLanes&);
};
extern const SurfaceKernel surface_avx2, surface_avx512;

/// Whether the processor has AVX-512; else it has AVX2.
bool wide_vectors();

}  // namespace diurna
