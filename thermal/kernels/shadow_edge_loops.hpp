#pragma once

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/column/step_weights.hpp"
#include "thermal/kernels/balance_root.hpp"

// A step in modes in which each facet's heat input has a jump at its own instant, compiled once for
// each vector width as thermal/kernels/balance_loops.hpp.

namespace diurna {

namespace {

/// [K] last correction inside a step: the error, 1e-4 K, decays to the step's end.
constexpr double near_inside = 5e-2;

/// A group of lanes in one part of its step.
struct SplitPart {
    alignas(64) double a[split_lanes], response[split_lanes];       // θ = a + response · drive
    alignas(64) double length[split_lanes], at_share[split_lanes];  // [s]; of the step, at its end
    alignas(64) double heat[split_lanes];                           // at its end
    alignas(64) double pull[split_lanes], b[split_lanes];  // flux + pull − b T = 0 is the balance
};

/// Length of the part and its heat input. Part 0 ends at the jump, the others follow to the step's
/// end.
[[gnu::always_inline]] inline void enter_part(const ModeCoefficients& c, const SplitLanes& s,
                                              std::size_t first, int part, SplitPart& p) {
    const double step = c.step;
#pragma omp simd
    for (std::size_t l = 0; l < split_lanes; ++l) {
        const std::size_t k = first + l;
        const double left = 1.0 - s.share[k];
        const double end = part == 0 ? s.share[k] : s.share[k] + left * part_after_jump[part];
        const double begin = part == 0 ? 0.0 : s.share[k] + left * part_after_jump[part - 1];
        const double smooth = s.heat[k] - s.heat_before[k] - s.jump[k];
        p.length[l] = (end - begin) * step;
        p.at_share[l] = end;
        p.heat[l] = s.heat_before[k] + end * smooth + (part == 0 ? 0.0 : s.jump[k]);
        s.drive[k] += part == 1 ? s.jump[k] : 0.0;
        p.a[l] = p.response[l] = 0.0;
    }
}

/// Modes decay over the part under the drive at its start.
[[gnu::always_inline]] inline void decay_part(const ModeCoefficients& c, const SplitLanes& s,
                                              std::size_t first, SplitPart& p) {
    alignas(64) double second[split_lanes];
    for (std::size_t m = 0; m < c.modes; ++m) {
        const double rate = c.rate[m], surface = c.surface[m];
        double* const x = s.state + m * split_capacity + first;
        double* const x_to = s.to + m * split_capacity + first;
        if (rate * c.step <= 0.25) {
#pragma omp simd
            for (std::size_t l = 0; l < split_lanes; ++l) {
                second[l] = small_second_weight(rate * p.length[l]);
            }
        } else {
#pragma omp simd
            for (std::size_t l = 0; l < split_lanes; ++l) {
                second[l] = second_weight(rate * p.length[l]);
            }
        }
#pragma omp simd
        for (std::size_t l = 0; l < split_lanes; ++l) {
            const double z = rate * p.length[l], weight = surface * p.length[l];
            const double one = 1.0 - z * second[l], decay = 1.0 - z * one;
            const double now = decay * x[l] + weight * (one - second[l]) * s.drive[first + l];
            x[l] = now;
            x_to[l] = weight * second[l];
            p.a[l] += surface * now;
            p.response[l] += surface * weight * second[l];
        }
    }
}

/// The balance at the part's end, and a first guess of its root.
[[gnu::always_inline]] inline void guess_part(const ModeCoefficients& c, const SplitLanes& s,
                                              std::size_t first, SplitPart& p) {
    const double film = c.film, reference = c.reference, flux_below = c.flux_below;
#pragma omp simd
    for (std::size_t l = 0; l < split_lanes; ++l) {
        const std::size_t k = first + l;
        const double stiffness = 1.0 / p.response[l], steep = s.slope[k] + film;
        p.b[l] = stiffness - film;
        p.pull[l] = stiffness * p.a[l] + p.b[l] * reference + flux_below + p.heat[l];
        s.temperature[k] =
            reference +
            (p.a[l] + p.response[l] * (s.drive[k] - steep * (s.temperature[k] - reference))) /
                (1.0 - p.response[l] * steep);
    }
}

/// Drives from the surface temperatures, and their part in the modes.
[[gnu::always_inline]] inline void leave_part(const ModeCoefficients& c, const SplitLanes& s,
                                              std::size_t first, const SplitPart& p) {
    const double reference = c.reference;
#pragma omp simd
    for (std::size_t l = 0; l < split_lanes; ++l) {
        s.drive[first + l] = (s.temperature[first + l] - reference - p.a[l]) / p.response[l];
    }
    for (std::size_t m = 0; m < c.modes; ++m) {
        double* const x = s.state + m * split_capacity + first;
        const double* const x_to = s.to + m * split_capacity + first;
#pragma omp simd
        for (std::size_t l = 0; l < split_lanes; ++l) x[l] += x_to[l] * s.drive[first + l];
    }
}

/// The air of all lanes of a group, or of each by its height.
struct SameSplit {
    SameAir at;
    double dew_point;  // [K]
    SameSplit(const AirFilm& air, const AirFilm*, double wet, double, const double*)
        : at{air}, dew_point(wet) {}
    [[gnu::always_inline]] Bends bend(std::size_t) const {
        return {dew_point, at.air.air_temperature};
    }
};
struct LaneSplit {
    AirByLane<split_lanes> at;
    alignas(64) double dew_point[split_lanes];
    LaneSplit(const AirFilm& low, const AirFilm* high, double wet_low, double wet_high,
              const double* up)
        : at(low, *high, up) {
        for (std::size_t l = 0; l < split_lanes; ++l) {
            dew_point[l] = wet_low + up[l] * (wet_high - wet_low);
        }
    }
    [[gnu::always_inline]] Bends bend(std::size_t l) const {
        return {dew_point[l], at.air_temperature[l]};
    }
};

template <FilmKind Kind, bool Wet, class Split>
bool split_group(const AirFilm& before, const AirFilm& after, const ModeCoefficients& c,
                 const SplitLanes& s, std::size_t first) {
    const double radiation = c.emissivity * stefan_boltzmann;
    // Copies, which no store through a pointer can change.
    const AirAbove& above = s.above;
    const double* const up = above.up ? above.up + first : nullptr;
    const Split from(before, above.before, s.dew_point_before, above.dew_point_before, up);
    const Split to(after, above.air, s.dew_point, above.dew_point, up);
    SplitPart p;
    bool halved = false;
    const auto film_at = [&](std::size_t l) __attribute__((always_inline)) {
        return air_between(from.at(l), to.at(l), p.at_share[l]);
    };
    const auto b_at = [&](std::size_t l) __attribute__((always_inline)) { return p.b[l]; };
    const auto bend_at = [&](std::size_t l) __attribute__((always_inline)) {
        const double back = 1.0 - p.at_share[l];
        const Bends begin = from.bend(l), end = to.bend(l);
        return Bends{end.dew_point + back * (begin.dew_point - end.dew_point),
                     end.air + back * (begin.air - end.air)};
    };
    for (int part = 0; part <= parts_after_jump; ++part) {
        enter_part(c, s, first, part, p);
        decay_part(c, s, first, p);
        guess_part(c, s, first, p);
        const double at_end = c.quick ? near_quick<Kind> : near_enough<Kind, Wet>;
        const double near = part < parts_after_jump ? near_inside : at_end;
        const RootOutcome root = find_roots<Kind, Wet, split_lanes>(
            film_at, bend_at, b_at,
            {s.natural + first, radiation, p.pull, s.temperature + first, s.slope + first}, near,
            [](std::size_t, double) {});
        halved = halved || root.halved;
        leave_part(c, s, first, p);
    }
    return halved;
}

template <class Split>
bool split_kind(const AirFilm& before, const AirFilm& air, const ModeCoefficients& c,
                const SplitLanes& s) {
    return by_kind(air.kind, air.wetness > 0.0, [&]<FilmKind Kind, bool Wet>() {
        bool halved = false;
        for (std::size_t g = 0; g < s.groups; ++g) {
            const bool more = split_group<Kind, Wet, Split>(before, air, c, s, g * split_lanes);
            halved = halved || more;
        }
        return halved;
    });
}
bool split_some(const AirFilm& before, const AirFilm& air, const ModeCoefficients& c,
                const SplitLanes& s) {
    return s.above.up ? split_kind<LaneSplit>(before, air, c, s)
                      : split_kind<SameSplit>(before, air, c, s);
}

}  // namespace

}  // namespace diurna
