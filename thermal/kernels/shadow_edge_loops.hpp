#pragma once

#include <algorithm>
#include <cmath>

#include "materials/base/fast_exp.hpp"
#include "materials/base/units.hpp"
#include "thermal/kernels/balance_loops.hpp"

// A step in modes in which each facet's heat jumps at an instant of its own, compiled once for each
// width of vectors as thermal/kernels/balance_loops.hpp is.

namespace diurna {

namespace {

/// (exp(−z) − 1 + z) / z² for z ≥ 0, from which exp(−z) and (1 − exp(−z)) / z follow.
[[gnu::always_inline]] inline double second_phi(double z) {
    double series = 1.0 / 20922789888000.0;  // Σ (−z)ᵏ / (k + 2)!, to z¹⁴ / 16!: 1e-15 at one
    series = 1.0 / 1307674368000.0 - z * series;
    series = 1.0 / 87178291200.0 - z * series;
    series = 1.0 / 6227020800.0 - z * series;
    series = 1.0 / 479001600.0 - z * series;
    series = 1.0 / 39916800.0 - z * series;
    series = 1.0 / 3628800.0 - z * series;
    series = 1.0 / 362880.0 - z * series;
    series = 1.0 / 40320.0 - z * series;
    series = 1.0 / 5040.0 - z * series;
    series = 1.0 / 720.0 - z * series;
    series = 1.0 / 120.0 - z * series;
    series = 1.0 / 24.0 - z * series;
    series = 1.0 / 6.0 - z * series;
    series = 0.5 - z * series;
    const double safe = z > 1.0 ? z : 1.0;
    const double closed = (fast_exp(-safe) - 1.0 + safe) / (safe * safe);
    return z > 1.0 ? closed : series;
}

/// The same for z ≤ 1/4, to 1e-12.
[[gnu::always_inline]] inline double second_phi_small(double z) {
    double series = 1.0 / 3628800.0;
    series = 1.0 / 362880.0 - z * series;
    series = 1.0 / 40320.0 - z * series;
    series = 1.0 / 5040.0 - z * series;
    series = 1.0 / 720.0 - z * series;
    series = 1.0 / 120.0 - z * series;
    series = 1.0 / 24.0 - z * series;
    series = 1.0 / 6.0 - z * series;
    return 0.5 - z * series;
}

/// Lengths of the parts of a step after a jump, as shares of what is left of it: what the true film
/// differs from the modes' follows the surface, which runs fast at first.
constexpr double part_share[]{0.0, 0.04, 0.15, 0.45, 1.0};
constexpr int parts = 4;
/// [K] of the last correction inside a step: what is left of it, 1e-4 K, decays to the step's end.
constexpr double near_inside = 5e-2;

template <bool Plate, bool Wet>
bool split_group(const AirFilm& before, const AirFilm& after, const ModeCoefficients& c,
                 const SplitLanes& s, std::size_t first) {
    const double radiation = c.emissivity * stefan_boltzmann;
    const double film = c.film, reference = c.reference, flux_below = c.flux_below, step = c.step;
    const AirFilm from = before, to = after;
    const double bend_before = s.dew_point_before, bend_after = s.dew_point;
    alignas(64) double a[split_lanes], response[split_lanes], length[split_lanes],
        at_share[split_lanes], heat[split_lanes], pull[split_lanes], b[split_lanes],
        second[split_lanes];
    bool halved = false;
    Balance<split_lanes> at;
    const auto film_at = [&](std::size_t l) __attribute__((always_inline)) {
        const double w = at_share[l];
        AirFilm air = to;
        air.air_temperature += (1.0 - w) * (from.air_temperature - to.air_temperature);
        air.neutral += (1.0 - w) * (from.neutral - to.neutral);
        air.instability += (1.0 - w) * (from.instability - to.instability);
        air.heat_capacity += (1.0 - w) * (from.heat_capacity - to.heat_capacity);
        air.vapour_pressure += (1.0 - w) * (from.vapour_pressure - to.vapour_pressure);
        air.latent += (1.0 - w) * (from.latent - to.latent);
        return air;
    };
    for (int part = 0; part <= parts; ++part) {
        // Part 0 leads to the jump, the others from there to the step's end.
#pragma omp simd
        for (std::size_t l = 0; l < split_lanes; ++l) {
            const std::size_t k = first + l;
            const double left = 1.0 - s.share[k];
            const double end = part == 0 ? s.share[k] : s.share[k] + left * part_share[part];
            const double begin = part == 0 ? 0.0 : s.share[k] + left * part_share[part - 1];
            const double smooth = s.heat[k] - s.heat_before[k] - s.jump[k];
            length[l] = (end - begin) * step;
            at_share[l] = end;
            heat[l] = s.heat_before[k] + end * smooth + (part == 0 ? 0.0 : s.jump[k]);
            s.drive[k] += part == 1 ? s.jump[k] : 0.0;
            a[l] = response[l] = 0.0;
        }
        for (std::size_t m = 0; m < c.modes; ++m) {
            const double rate = c.rate[m], surface = c.surface[m];
            double* const x = s.state + m * split_capacity + first;
            double* const x_to = s.to + m * split_capacity + first;
            if (rate * step <= 0.25) {
#pragma omp simd
                for (std::size_t l = 0; l < split_lanes; ++l) {
                    second[l] = second_phi_small(rate * length[l]);
                }
            } else {
#pragma omp simd
                for (std::size_t l = 0; l < split_lanes; ++l) {
                    second[l] = second_phi(rate * length[l]);
                }
            }
#pragma omp simd
            for (std::size_t l = 0; l < split_lanes; ++l) {
                const double z = rate * length[l], weight = surface * length[l];
                const double one = 1.0 - z * second[l], decay = 1.0 - z * one;
                const double now = decay * x[l] + weight * (one - second[l]) * s.drive[first + l];
                x[l] = now;
                x_to[l] = weight * second[l];
                a[l] += surface * now;
                response[l] += surface * weight * second[l];
            }
        }
#pragma omp simd
        for (std::size_t l = 0; l < split_lanes; ++l) {
            const std::size_t k = first + l;
            const double stiffness = 1.0 / response[l], steep = s.slope[k] + film;
            b[l] = stiffness - film;
            pull[l] = stiffness * a[l] + b[l] * reference + flux_below + heat[l];
            s.temperature[k] =
                reference +
                (a[l] + response[l] * (s.drive[k] - steep * (s.temperature[k] - reference))) /
                    (1.0 - response[l] * steep);
        }
        const double near = part < parts ? near_inside : near_enough<Plate>;
        int iterations = 0;
        double largest;
        do {
            largest = 0.0;
            evaluate<Plate, Wet>(film_at, s.natural + first, radiation, s.temperature + first, at);
#pragma omp simd reduction(max : largest)
            for (std::size_t l = 0; l < split_lanes; ++l) {
                const std::size_t k = first + l;
                const double bend = bend_after + (1.0 - at_share[l]) * (bend_before - bend_after);
                const double t = s.temperature[k];
                const double correction = (at.flux[l] + pull[l] - b[l] * t) / (b[l] - at.slope[l]);
                const double next = t + correction;
                s.temperature[k] = next;
                s.slope[k] = at.slope[l];
                const double size = size_of<Wet>(correction, t, next, bend);
                largest = size > largest ? size : largest;
            }
            ++iterations;
        } while (largest > near && iterations < newton_steps);
        if (largest > near) {
            halved = true;
            double low[split_lanes], high[split_lanes];
            std::fill_n(low, split_lanes, coldest);
            std::fill_n(high, split_lanes, hottest);
            for (int i = 0; i < halvings; ++i) {
                for (std::size_t l = 0; l < split_lanes; ++l) {
                    s.temperature[first + l] = 0.5 * (low[l] + high[l]);
                }
                evaluate<Plate, Wet>(film_at, s.natural + first, radiation, s.temperature + first,
                                     at);
                for (std::size_t l = 0; l < split_lanes; ++l) {
                    const double t = s.temperature[first + l];
                    const bool colder = at.flux[l] + pull[l] - b[l] * t > 0.0;
                    (colder ? low : high)[l] = t;
                    s.slope[first + l] = at.slope[l];
                }
            }
        }
#pragma omp simd
        for (std::size_t l = 0; l < split_lanes; ++l) {
            s.drive[first + l] = (s.temperature[first + l] - reference - a[l]) / response[l];
        }
        for (std::size_t m = 0; m < c.modes; ++m) {
            double* const x = s.state + m * split_capacity + first;
            const double* const x_to = s.to + m * split_capacity + first;
#pragma omp simd
            for (std::size_t l = 0; l < split_lanes; ++l) x[l] += x_to[l] * s.drive[first + l];
        }
    }
    return halved;
}

bool split_some(const AirFilm& before, const AirFilm& air, const ModeCoefficients& c,
                const SplitLanes& s) {
    const bool wet = air.wetness > 0.0;
    bool halved = false;
    for (std::size_t g = 0; g < s.groups; ++g) {
        const std::size_t first = g * split_lanes;
        const bool more = air.plate ? (wet ? split_group<true, true>(before, air, c, s, first)
                                           : split_group<true, false>(before, air, c, s, first))
                                    : (wet ? split_group<false, true>(before, air, c, s, first)
                                           : split_group<false, false>(before, air, c, s, first));
        halved = halved || more;
    }
    return halved;
}

}  // namespace

}  // namespace diurna
