#pragma once

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/column/column.hpp"
#include "thermal/kernels/surface_kernel.hpp"
#include "thermal/surface/surface_flux.hpp"

// The loops of the surface balance, compiled once for each vector width (kernels_avx2.cpp,
// kernels_avx512.cpp); everything here is local to the unit that includes it. The arithmetic of a
// lane is the same in all of them except which products the compiler fuses into sums: 4 ulp of the
// terms (tests/thermal/vector_lanes_test.cpp).

namespace diurna {

namespace {

constexpr double coldest = 1.0, hottest = 5000.0;  // [K] bracket
constexpr int patience = 3;                        // iterations before Newton must halve its steps
constexpr int most_iterations = 80;                // bisection alone needs 53 to its last bit

/// [K] of the last correction. For smooth ground the error is of second order; where dew begins,
/// and where a plate has the air's temperature, the balance has a kink.
template <FilmKind Kind, bool Wet>
constexpr double settled_at = !on_ground<Kind> ? 1e-8
                              : Wet            ? 1e-6
                                               : 1e-5;

template <FilmKind Kind, bool Wet>
SurfaceCount newton(const AirFilm& given, const SurfaceLanes& s) {
    constexpr double settled = settled_at<Kind, Wet>;
    // Copies, which no store through a pointer can change, so that the loop is vectorised.
    const AirFilm air = given;
    const double radiation = s.emissivity * stefan_boltzmann, b = s.b, reference = s.reference;
    const double* const heat = s.heat;
    const double* const a = s.a;
    const NaturalFilm* const natural = s.natural;
    double* const temperature = s.temperature;
    const std::size_t count = s.count;
    double low[lanes], high[lanes], last_step[lanes], flux_at[lanes], slope_at[lanes];
    std::fill_n(low, count, coldest);
    std::fill_n(high, count, hottest);
    std::fill_n(last_step, count, hottest);
    SurfaceCount result;
    double correction = hottest;
    while (correction > settled && result.iterations < most_iterations) {
        correction = 0.0;
        double outliers = 0.0;
        const double steady_share = result.iterations < patience ? hottest : 0.5;
#pragma omp simd reduction(max : correction) reduction(+ : outliers)
        for (std::size_t l = 0; l < count; ++l) {
            const double t = temperature[l];
            const SurfaceFlux at = surface_flux<Kind, Wet>(air, natural[l], radiation, heat[l], t);
            const double flux = at.flux, slope = at.slope;
            const double excess = flux + a[l] - b * (t - reference);
            const double from = excess > 0.0 ? t : low[l];
            const double to = excess < 0.0 ? t : high[l];
            const double newton_step = excess / (b - slope);
            const double wanted = t + newton_step;
            // Newton may oscillate about a kink for ever: between two points with the root in
            // between it must halve its steps, or the bracket is halved instead.
            const double most = to - from < hottest / 2.0 ? steady_share * last_step[l] : hottest;
            double stray = std::abs(newton_step) > most + settled ? 1.0 : 0.0;
            stray = wanted < from - settled ? 1.0 : stray;
            stray = wanted > to + settled ? 1.0 : stray;
            const double middle = 0.5 * (from + to);
            const double next = stray > 0.0 ? middle : wanted;
            const double step = std::abs(next - t);
            low[l] = from;
            high[l] = to;
            last_step[l] = step;
            temperature[l] = next;
            flux_at[l] = flux + slope * (next - t);
            slope_at[l] = slope;
            // A halved bracket only shows that the root is inside.
            const double unsettled = stray > 0.0 ? to - from : step;
            correction = unsettled > correction ? unsettled : correction;
            outliers += stray;
        }
        result.bisections += static_cast<std::size_t>(outliers);
        ++result.iterations;
    }
    std::copy_n(flux_at, count, s.flux);
    std::copy_n(slope_at, count, s.slope);
    return result;
}

SurfaceCount solve(const AirFilm& air, const SurfaceLanes& surface) {
    return by_kind(air.kind, air.wetness > 0.0,
                   [&]<FilmKind Kind, bool Wet>() { return newton<Kind, Wet>(air, surface); });
}

}  // namespace

}  // namespace diurna
