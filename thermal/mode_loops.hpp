#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "materials/fast_exp.hpp"
#include "materials/units.hpp"
#include "thermal/mode_kernel.hpp"
#include "thermal/surface_loops.hpp"

// The loops of a step in modes, compiled once for each width of vectors (surface_avx2.cpp,
// surface_avx512.cpp); everything here belongs to the unit that includes it.
//
// One evaluation of the surface balance is a chain of some 250 cycles of latency but a quarter of
// that of work. It is cut into loops over all lanes, each so short that the processor's schedulers
// hold every vector of it at once and work on them side by side.

namespace diurna {

namespace {

constexpr int newton_steps = 10;  // more than a bend takes
constexpr int halvings = 56;      // of the bracket 1 to 5000 K, to its last bit

/// [K] of the last correction, which has been applied: what is left goes with its square, 1e-9 K
/// and less for ground; a plate's film rises from the air's temperature with an upright tangent.
template <bool Plate>
constexpr double near_enough = Plate ? 1e-8 : 1e-4;

constexpr double murray_a = 17.2693882, murray_b = 35.86, triple_point = 273.16;  // Murray 1967
constexpr double coldest_vapour = 100.0, hottest_vapour = 450.0;                  // [K] his range

/// A correction that leads across the bend proves nothing of what is left, unless it is tiny.
template <bool Wet>
[[gnu::always_inline]] inline double size_of(double correction, double t, double next,
                                             double bend) {
    double size = std::abs(correction);
    if (Wet) size = (t - bend) * (next - bend) < 0.0 ? 1e3 * size : size;
    // Comparisons with NaN are false: it counts as far away.
    return size < 1e9 ? size : 1e9;
}

/// The surface balance of `Count` lanes: what ground_film, plate_film and latent_heat of
/// thermal/turbulence.hpp say (tests/mode_batch_test), in short loops. Air [lane] where it changes
/// from lane to lane (`Mixed`), else as it is.
template <std::size_t Count>
struct Balance {
    alignas(64) double flux[Count], slope[Count];
};
struct SameAir {
    AirFilm air;
    [[gnu::always_inline]] const AirFilm& operator()(std::size_t) const { return air; }
};
template <bool Plate, bool Wet, std::size_t Count, class Air>
[[gnu::always_inline]] inline void evaluate(const Air& air_at, const NaturalFilm* natural,
                                            double radiation, const double* temperature,
                                            Balance<Count>& result) {
    alignas(64) double h[Count], film_slope[Count], pressure[Count], rest[Count], inverse[Count],
        scale[Count];
    double *const flux = result.flux, *const slope = result.slope;
#pragma omp simd
    for (std::size_t l = 0; l < Count; ++l) {
        const AirFilm& air = air_at(l);
        const double t = temperature[l];
        const Film film = Plate ? plate_film(air, natural[l], t) : ground_film(air, t);
        const double cube = radiation * t * t * t;
        flux[l] = -cube * t - film.h * (t - air.air_temperature);
        slope[l] = -4.0 * cube - film.h - film.rise;
        h[l] = film.h;
        film_slope[l] = film.slope;
    }
    if (!Wet) return;
#pragma omp simd
    for (std::size_t l = 0; l < Count; ++l) {
        const double t = std::min(std::max(temperature[l], coldest_vapour), hottest_vapour);
        inverse[l] = 1.0 / (t - murray_b);
        // As in fast_exp: 2ᵏ eʳ.
        constexpr double log2_e = 1.4426950408889634074, shifter = 0x1.8p52;
        constexpr double ln2_high = 6.93147180369123816490e-01,
                         ln2_low = 1.90821492927058770002e-10;
        const double x = murray_a * (t - triple_point) * inverse[l];
        const double shifted = x * log2_e + shifter, k = shifted - shifter;
        rest[l] = (x - k * ln2_high) - k * ln2_low;
        scale[l] = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023u) << 52);
    }
#pragma omp simd
    for (std::size_t l = 0; l < Count; ++l) {
        const double r = rest[l];
        double p = 1.0 / 479001600.0;
        p = p * r + 1.0 / 39916800.0;
        p = p * r + 1.0 / 3628800.0;
        p = p * r + 1.0 / 362880.0;
        p = p * r + 1.0 / 40320.0;
        p = p * r + 1.0 / 5040.0;
        p = p * r + 1.0 / 720.0;
        p = p * r + 1.0 / 120.0;
        p = p * r + 1.0 / 24.0;
        p = p * r + 1.0 / 6.0;
        p = p * r + 0.5;
        p = p * r + 1.0;
        p = p * r + 1.0;
        pressure[l] = 610.78 * scale[l] * p;
    }
#pragma omp simd
    for (std::size_t l = 0; l < Count; ++l) {
        const AirFilm& air = air_at(l);
        const double steep =
            pressure[l] * (murray_a * (triple_point - murray_b)) * inverse[l] * inverse[l];
        const double above = std::max(0.0, temperature[l] - hottest_vapour);
        const double excess = pressure[l] + steep * above - air.vapour_pressure;
        const bool drying = excess > 0.0;
        const double resistance = drying ? air.resistance : 0.0;
        const double share = air.latent * (drying ? air.wetness : 1.0);
        const double in_series = 1.0 / (air.heat_capacity + resistance * h[l]);
        const double conductance = h[l] * in_series;
        const double steeper = air.heat_capacity * in_series * in_series * film_slope[l];
        flux[l] -= share * conductance * excess;
        slope[l] -= share * (conductance * steep + steeper * excess);
    }
}

template <bool Plate, bool Wet>
ModeOutcome advance_lanes(const AirFilm& before, const AirFilm& given, const ModeCoefficients& c,
                          const ModeLanes& s) {
    // Values of its own, which no store through a pointer can change, let the loops become vectors.
    const AirFilm air = given;
    const double radiation = c.emissivity * stefan_boltzmann, response = c.response;
    const double stiffness = 1.0 / response, film = c.film, reference = c.reference;
    const double b = stiffness - film, flux_below = c.flux_below;
    const double warmer = air.air_temperature - before.air_temperature;
    const double bend = s.dew_point;
    alignas(64) double a[lanes] = {}, pull[lanes], t_now[lanes], flux[lanes];
    Balance<lanes> at;
    for (std::size_t m = 0; m < c.modes; ++m) {
        const double decay = c.decay[m], carry = c.carry[m], surface = c.surface[m];
        double* const x = s.state + m * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l) {
            x[l] = decay * x[l] + carry * s.drive[l];
            a[l] += surface * x[l];
        }
    }
    const double base = b * reference + flux_below;
#pragma omp simd
    for (std::size_t l = 0; l < lanes; ++l) {
        pull[l] = stiffness * a[l] + base + s.heat[l];
        // Newton starts where the surface would be if it went on as straight as it was, under what
        // sun and air bring now.
        const double t = s.temperature[l], slope = s.slope[l];
        const double brought =
            s.heat[l] - s.heat_before[l] - (slope + 4.0 * radiation * t * t * t) * warmer;
        const double steep = slope + film;
        t_now[l] =
            reference + (a[l] + response * (s.drive[l] + brought - steep * (t - reference))) /
                            (1.0 - response * steep);
    }
    ModeOutcome outcome{};
    double largest;
    do {
        largest = 0.0;
        evaluate<Plate, Wet>(SameAir{air}, s.natural, radiation, t_now, at);
#pragma omp simd reduction(max : largest)
        for (std::size_t l = 0; l < lanes; ++l) {
            const double t = t_now[l];
            const double correction = (at.flux[l] + pull[l] - b * t) / (b - at.slope[l]);
            const double next = t + correction;
            t_now[l] = next;
            flux[l] = at.flux[l] + at.slope[l] * correction;
            s.slope[l] = at.slope[l];
            const double size = size_of<Wet>(correction, t, next, bend);
            largest = size > largest ? size : largest;
        }
        ++outcome.iterations;
    } while (largest > near_enough<Plate> && outcome.iterations < newton_steps);
    outcome.halved = largest > near_enough<Plate>;
    if (outcome.halved) {
        alignas(64) double low[lanes], high[lanes];
        std::fill_n(low, lanes, coldest);
        std::fill_n(high, lanes, hottest);
        for (int i = 0; i < halvings; ++i) {
            for (std::size_t l = 0; l < lanes; ++l) t_now[l] = 0.5 * (low[l] + high[l]);
            evaluate<Plate, Wet>(SameAir{air}, s.natural, radiation, t_now, at);
            for (std::size_t l = 0; l < lanes; ++l) {
                const bool colder = at.flux[l] + pull[l] - b * t_now[l] > 0.0;
                (colder ? low : high)[l] = t_now[l];
                flux[l] = at.flux[l];
                s.slope[l] = at.slope[l];
            }
        }
    }
    double worst = 0.0;
#pragma omp simd reduction(max : worst)
    for (std::size_t l = 0; l < lanes; ++l) {
        const double t = t_now[l], theta = t - reference;
        const double u = stiffness * (theta - a[l]);
        const double left = std::abs(flux[l] + s.heat[l] + film * theta + flux_below - u);
        const double square = t * t;
        const double terms =
            std::abs(s.heat[l]) + radiation * square * square + std::abs(flux[l] + s.heat[l]) + 1.0;
        const double open = left / terms;
        worst = open > worst ? open : worst;
        s.temperature[l] = t;
        s.drive[l] = u;
    }
    outcome.closure = worst;
    return outcome;
}

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
/// [K] of the last correction inside a step: what is left of it, 1e-6 K, decays to the step's end.
constexpr double near_inside = 1e-2;

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

ModeOutcome advance_all(const AirFilm& before, const AirFilm& air, const ModeCoefficients& c,
                        const ModeLanes& s) {
    const bool wet = air.wetness > 0.0;
    if (air.plate) {
        return wet ? advance_lanes<true, true>(before, air, c, s)
                   : advance_lanes<true, false>(before, air, c, s);
    }
    return wet ? advance_lanes<false, true>(before, air, c, s)
               : advance_lanes<false, false>(before, air, c, s);
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
