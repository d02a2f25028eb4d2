#pragma once

#include <algorithm>

#include "thermal/kernels/balance_loops.hpp"

// The root of the surface balance of columns in modes, for whole steps and for parts of steps at a
// shadow's edge; compiled once for each vector width as balance_loops.hpp.

namespace diurna {

namespace {

/// Balances flux(T) + pull − b T = 0, one for each lane.
struct RootLanes {
    const NaturalFilm* natural;
    double radiation;     // emissivity × Stefan-Boltzmann constant [W m⁻² K⁻⁴]
    const double* pull;   // [W m⁻²]
    double* temperature;  // [K] in: a guess; out: the root
    double* slope;        // out: of the flux there [W m⁻² K⁻¹]
};
struct RootOutcome {
    int iterations = 0;   // of Newton's, the same for all lanes
    bool halved = false;  // Newton oscillated, and the bracket was halved to its end
};

/// Newton until the last correction of every lane is at most `near` [K], which is applied; by
/// halving the bracket 1 to 5000 K to its last bit if ten steps do not suffice.
///
/// - air_at (lane), bend_at (lane): air and kinks, as evaluate() and size_of()
/// - b_at (lane): b [W m⁻² K⁻¹]
/// - keep (lane, flux): receives the flux at the root
template <FilmKind Kind, bool Wet, std::size_t Count, class Air, class Bend, class Stiffness,
          class Keep>
[[gnu::always_inline]] inline RootOutcome find_roots(const Air& air_at, const Bend& bend_at,
                                                     const Stiffness& b_at, const RootLanes& s,
                                                     double near, const Keep& keep) {
    Balance<Count> at;
    RootOutcome outcome;
    double largest;
    do {
        largest = 0.0;
        evaluate<Kind, Wet>(air_at, s.natural, s.radiation, s.temperature, at);
#pragma omp simd reduction(max : largest)
        for (std::size_t l = 0; l < Count; ++l) {
            const double t = s.temperature[l], b = b_at(l);
            const double correction = (at.flux[l] + s.pull[l] - b * t) / (b - at.slope[l]);
            const double next = t + correction;
            s.temperature[l] = next;
            keep(l, at.flux[l] + at.slope[l] * correction);
            s.slope[l] = at.slope[l];
            const double size = size_of<Wet>(correction, t, next, bend_at(l));
            largest = size > largest ? size : largest;
        }
        ++outcome.iterations;
    } while (largest > near && outcome.iterations < newton_steps);
    outcome.halved = largest > near;
    if (!outcome.halved) return outcome;
    alignas(64) double low[Count], high[Count];
    std::fill_n(low, Count, coldest);
    std::fill_n(high, Count, hottest);
    for (int i = 0; i < halvings; ++i) {
        for (std::size_t l = 0; l < Count; ++l) s.temperature[l] = 0.5 * (low[l] + high[l]);
        evaluate<Kind, Wet>(air_at, s.natural, s.radiation, s.temperature, at);
        for (std::size_t l = 0; l < Count; ++l) {
            const double t = s.temperature[l];
            const bool colder = at.flux[l] + s.pull[l] - b_at(l) * t > 0.0;
            (colder ? low : high)[l] = t;
            keep(l, at.flux[l]);
            s.slope[l] = at.slope[l];
        }
    }
    return outcome;
}

}  // namespace

}  // namespace diurna
