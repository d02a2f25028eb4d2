#pragma once

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/kernels/balance_root.hpp"

// A whole step in modes, the same step for all facets, compiled once for each vector width as
// thermal/kernels/balance_loops.hpp.

namespace diurna {

namespace {

/// Lanes within a step: θ = a + drive / stiffness, and the balance at its end, flux + pull − b T =
/// 0.
struct ModeWay {
    alignas(64) double a[lanes] = {}, pull[lanes], temperature[lanes], flux[lanes];
};

/// Modes decay over the step under the drive at its start.
[[gnu::always_inline]] inline void decay_modes(const ModeCoefficients& c, const ModeLanes& s,
                                               ModeWay& way) {
    for (std::size_t m = 0; m < c.modes; ++m) {
        const double decay = c.decay[m], carry = c.carry[m], surface = c.surface[m];
        double* const x = s.state + m * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l) {
            x[l] = decay * x[l] + carry * s.drive[l];
            way.a[l] += surface * x[l];
        }
    }
}

/// Air of a step: the same for all lanes.
struct SameStep {
    SameAir at;
    double warmer_by, dew_point;  // [K] than before; kink of the balance
    SameStep(const AirFilm& before, const AirFilm& after, const ModeLanes& s)
        : at{after},
          warmer_by(after.air_temperature - before.air_temperature),
          dew_point(s.dew_point) {}
    [[gnu::always_inline]] double warmer(std::size_t) const { return warmer_by; }
    [[gnu::always_inline]] Bends bend(std::size_t) const {
        return {dew_point, at.air.air_temperature};
    }
};
/// Air of a step by the height of each lane.
struct LaneStep {
    AirByLane<lanes> at;
    alignas(64) double warmer_by[lanes], dew_point[lanes];
    LaneStep(const AirFilm& before, const AirFilm& after, const ModeLanes& s)
        : at(after, *s.above.air, s.above.up) {
        const double low = before.air_temperature, high = s.above.before->air_temperature;
        const double wet_low = s.dew_point, wet_high = s.above.dew_point;
        const double* const up = s.above.up;
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l) {
            warmer_by[l] = at.air_temperature[l] - (low + up[l] * (high - low));
            dew_point[l] = wet_low + up[l] * (wet_high - wet_low);
        }
    }
    [[gnu::always_inline]] double warmer(std::size_t l) const { return warmer_by[l]; }
    [[gnu::always_inline]] Bends bend(std::size_t l) const {
        return {dew_point[l], at.air_temperature[l]};
    }
};

template <FilmKind Kind, bool Wet, class Step>
ModeOutcome advance_lanes(const AirFilm& before, const AirFilm& given, const ModeCoefficients& c,
                          const ModeLanes& s) {
    // Copies, which no store through a pointer can change, so that the loops are vectorised.
    const Step air(before, given, s);
    const double radiation = c.emissivity * stefan_boltzmann, response = c.response;
    const double stiffness = 1.0 / response, film = c.film, reference = c.reference;
    const double b = stiffness - film, flux_below = c.flux_below;
    ModeWay way;
    decay_modes(c, s, way);
    const double base = b * reference + flux_below;
#pragma omp simd
    for (std::size_t l = 0; l < lanes; ++l) {
        way.pull[l] = stiffness * way.a[l] + base + s.heat[l];
        // Newton starts at the linear extrapolation of the surface temperature, under the present
        // sun and air.
        const double t = s.temperature[l], slope = s.slope[l];
        const double brought =
            s.heat[l] - s.heat_before[l] - (slope + 4.0 * radiation * t * t * t) * air.warmer(l);
        const double steep = slope + film;
        way.temperature[l] =
            reference + (way.a[l] + response * (s.drive[l] + brought - steep * (t - reference))) /
                            (1.0 - response * steep);
    }
    const RootOutcome root = find_roots<Kind, Wet, lanes>(
        air.at, [&](std::size_t l) __attribute__((always_inline)) { return air.bend(l); },
        [b](std::size_t) __attribute__((always_inline)) { return b; },
        {s.natural, radiation, way.pull, way.temperature, s.slope},
        c.quick ? near_quick<Kind> : near_enough<Kind, Wet>,
        [&](std::size_t l, double flux) __attribute__((always_inline)) { way.flux[l] = flux; });
    ModeOutcome outcome{.iterations = root.iterations, .halved = root.halved};
    double worst = 0.0;
#pragma omp simd reduction(max : worst)
    for (std::size_t l = 0; l < lanes; ++l) {
        const double t = way.temperature[l], theta = t - reference;
        const double u = stiffness * (theta - way.a[l]);
        const double left = std::abs(way.flux[l] + s.heat[l] + film * theta + flux_below - u);
        const double square = t * t;
        const double terms = std::abs(s.heat[l]) + radiation * square * square +
                             std::abs(way.flux[l] + s.heat[l]) + 1.0;
        const double open = left / terms;
        worst = open > worst ? open : worst;
        s.temperature[l] = t;
        s.drive[l] = u;
    }
    outcome.closure = worst;
    return outcome;
}

template <FilmKind Kind, bool Wet>
void balance_lanes(const AirFilm& air, const NaturalFilm* natural, double radiation,
                   const double* temperature, double* flux, double* slope) {
    Balance<lanes> at;
    evaluate<Kind, Wet>(SameAir{air}, natural, radiation, temperature, at);
    std::copy_n(at.flux, lanes, flux);
    std::copy_n(at.slope, lanes, slope);
}
void balance_all(const AirFilm& air, const NaturalFilm* natural, double radiation,
                 const double* temperature, double* flux, double* slope) {
    by_kind(air.kind, air.wetness > 0.0, [&]<FilmKind Kind, bool Wet>() {
        balance_lanes<Kind, Wet>(air, natural, radiation, temperature, flux, slope);
    });
}

template <class Step>
ModeOutcome advance_kind(const AirFilm& before, const AirFilm& air, const ModeCoefficients& c,
                         const ModeLanes& s) {
    return by_kind(air.kind, air.wetness > 0.0, [&]<FilmKind Kind, bool Wet>() {
        return advance_lanes<Kind, Wet, Step>(before, air, c, s);
    });
}
ModeOutcome advance_all(const AirFilm& before, const AirFilm& air, const ModeCoefficients& c,
                        const ModeLanes& s) {
    return s.above.up ? advance_kind<LaneStep>(before, air, c, s)
                      : advance_kind<SameStep>(before, air, c, s);
}

}  // namespace

}  // namespace diurna
