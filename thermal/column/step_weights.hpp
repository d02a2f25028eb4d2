#pragma once

#include <cmath>

#include "materials/base/fast_exp.hpp"

namespace diurna {

/// Weights of a step for a state that decays at a rate: the remaining share of the state, and the
/// effect of a constant drive and of one that rises from zero to one; z = rate · step ≥ 0:
///
///     decay = e⁻ᶻ,    first = (1 − e⁻ᶻ) / z,    second = (e⁻ᶻ − 1 + z) / z²
///
/// (the φ functions of exponential integrators; Hochbruck & Ostermann 2010), each to 1e-14.
/// (T20) of docs/theory.md
struct StepWeights {
    double decay, first, second;
};

/// Σ (−z)ᵏ / (k + 2)! up to k = Last − 2, by Horner: `second` near zero. For loops over lanes.
template <int Last, int K = 2>
[[gnu::always_inline]] constexpr double second_weight_series(double z) {
    double factorial = 1.0;
    for (int k = 2; k <= K; ++k) factorial *= k;
    if constexpr (K == Last) {
        return 1.0 / factorial;
    } else {
        return 1.0 / factorial - z * second_weight_series<Last, K + 1>(z);
    }
}

/// `second` for loops over lanes, from which first = 1 − z second and decay = 1 − z first follow.
[[gnu::always_inline]] inline double second_weight(double z) {
    const double series = second_weight_series<16>(z);
    const double safe = z > 1.0 ? z : 1.0;
    const double closed = (fast_exp(-safe) - 1.0 + safe) / (safe * safe);
    return z > 1.0 ? closed : series;
}
/// The same for z ≤ 1/4, to 1e-12.
[[gnu::always_inline]] inline double small_second_weight(double z) {
    return second_weight_series<10>(z);
}

inline StepWeights step_weights(double z) {
    if (z <= 0.25) {
        const double second = small_second_weight(z), first = 1.0 - z * second;
        return {1.0 - z * first, first, second};
    }
    const double fall = std::expm1(-z);
    return {1.0 + fall, -fall / z, (z + fall) / (z * z)};
}

}  // namespace diurna
