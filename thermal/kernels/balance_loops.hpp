#pragma once

#include <algorithm>
#include <cmath>

#include "materials/air/saturation.hpp"
#include "materials/base/fast_exp.hpp"
#include "thermal/kernels/mode_kernel.hpp"
#include "thermal/kernels/surface_loops.hpp"

// The surface balance of columns in modes, several lanes in parallel, compiled once for each vector
// width (kernels_avx2.cpp, kernels_avx512.cpp); everything here is local to the unit that includes
// it.
//
// One evaluation is a chain with a latency of some 250 cycles but only a quarter of that as work.
// It is split into loops over all lanes, each so short that the processor's schedulers hold all of
// its vectors at once and process them in parallel.

namespace diurna {

namespace {

constexpr int newton_steps = 10;  // more than a kink needs
constexpr int halvings = 56;      // of the bracket 1 to 5000 K, to its last bit

/// [K] size of the last correction, which has been applied: the remaining error is of second order,
/// 1e-9 K and less for ground; for wet ground in calm, dry air 100 times the square; a plate's film
/// has a vertical tangent at the air's temperature.
template <FilmKind Kind, bool Wet>
constexpr double near_enough = !on_ground<Kind> ? 1e-8
                               : Wet            ? 1e-6
                                                : 1e-4;

/// The same where a millikelvin does not matter: the balance of ground bends by 0.01 K⁻¹ and less.
template <FilmKind Kind>
constexpr double near_quick = on_ground<Kind> ? 5e-2 : 1e-3;

/// Kinks of a wet surface's balance [K]: at the dew point, and at the air's temperature, where film
/// and vapour flux change with the root of the difference.
struct Bends {
    double dew_point, air;
};
/// A correction that crosses the dew point, or is not small compared with the distance to the air's
/// temperature, is no measure of the remaining error, unless it is tiny.
template <bool Wet>
[[gnu::always_inline]] inline double size_of(double correction, double t, double next, Bends bend) {
    double size = std::abs(correction);
    if (Wet) {
        const double across = (t - bend.dew_point) * (next - bend.dew_point);
        const double from_air = std::abs(next - bend.air);
        size *= across < 0.0 || from_air < 20.0 * size ? 1e3 : 1.0;
    }
    // Comparisons with NaN are false: NaN counts as large.
    return size < 1e9 ? size : 1e9;
}

/// The surface balance of `Count` lanes: equal to film_of and latent_heat of thermal/surface to 4
/// ulp of its terms (tests/thermal/vector_lanes_test.cpp), in short loops. `air_at` (lane) is the
/// air, which may differ between lanes.
template <std::size_t Count>
struct Balance {
    alignas(64) double flux[Count], slope[Count];
};
struct SameAir {
    AirFilm air;
    [[gnu::always_inline]] const AirFilm& operator()(std::size_t) const { return air; }
};
/// Air of lanes at different heights: interpolated between two heights (air_between). Value by
/// value, by hand: with each_air_field() the kernels of modes take 38 % more time.
template <std::size_t Count>
struct AirByLane {
    alignas(64) double air_temperature[Count], neutral[Count], instability[Count];
    alignas(64) double heat_capacity[Count], vapour_pressure[Count], latent[Count];
    alignas(64) double conduct[Count], sixth[Count], quarter[Count], third[Count];
    alignas(64) double laminar[Count], turbulent[Count], edge[Count];
    double a, c, s, least, resistance, wetness;  // the same at all heights
    PlateAir plate;                              // values of plates that no array holds
    FilmKind kind;

    /// up  (lane) fraction of the way from `low` to `high`
    AirByLane(const AirFilm& low, const AirFilm& high, const double* up)
        : a(high.a),
          c(high.c),
          s(high.s),
          least(high.least),
          resistance(high.resistance),
          wetness(high.wetness),
          plate(high.plate),
          kind(high.kind) {
        const auto between = [up](double from, double to, double* lane) {
#pragma omp simd
            for (std::size_t l = 0; l < Count; ++l) lane[l] = to + (1.0 - up[l]) * (from - to);
        };
        between(low.air_temperature, high.air_temperature, air_temperature);
        between(low.neutral, high.neutral, neutral);
        between(low.instability, high.instability, instability);
        between(low.heat_capacity, high.heat_capacity, heat_capacity);
        between(low.vapour_pressure, high.vapour_pressure, vapour_pressure);
        between(low.latent, high.latent, latent);
        if (kind == FilmKind::ground || kind == FilmKind::sheltered_ground) return;
        between(low.plate.conduct, high.plate.conduct, conduct);
        between(low.plate.sixth, high.plate.sixth, sixth);
        between(low.plate.quarter, high.plate.quarter, quarter);
        between(low.plate.third, high.plate.third, third);
        between(low.plate.laminar, high.plate.laminar, laminar);
        between(low.plate.turbulent, high.plate.turbulent, turbulent);
        between(low.plate.edge, high.plate.edge, edge);
    }
    [[gnu::always_inline]] AirFilm operator()(std::size_t l) const {
        return {.air_temperature = air_temperature[l],
                .neutral = neutral[l],
                .instability = instability[l],
                .a = a,
                .c = c,
                .s = s,
                .least = least,
                .heat_capacity = heat_capacity[l],
                .vapour_pressure = vapour_pressure[l],
                .latent = latent[l],
                .resistance = resistance,
                .wetness = wetness,
                .kind = kind,
                .plate = {.conduct = conduct[l],
                          .sixth = sixth[l],
                          .quarter = quarter[l],
                          .third = third[l],
                          .laminar = laminar[l],
                          .turbulent = turbulent[l],
                          .edge = edge[l],
                          .warming = plate.warming,
                          .roughness = plate.roughness,
                          .quadratic = plate.quadratic}};
    }
};
template <FilmKind Kind, bool Wet, std::size_t Count, class Air>
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
        const Film film = film_of<Kind>(air, natural[l], t);
        const DryLoss dry = dry_loss(air, film, radiation, t);
        flux[l] = -dry.emitted - dry.sensible;
        slope[l] = -dry.slope;
        h[l] = film.h;
        film_slope[l] = film.slope;
    }
    if (!Wet) return;
#pragma omp simd
    for (std::size_t l = 0; l < Count; ++l) {
        const double t = std::min(std::max(temperature[l], coldest_vapour), hottest_vapour);
        inverse[l] = 1.0 / (t - over_water.b);
        const ExpParts parts = exp_parts(saturation_exponent(over_water, t, inverse[l]));
        rest[l] = parts.rest;
        scale[l] = parts.scale;
    }
#pragma omp simd
    for (std::size_t l = 0; l < Count; ++l) {
        pressure[l] = triple_point_pressure * scale[l] * exp_series(rest[l]);
    }
#pragma omp simd
    for (std::size_t l = 0; l < Count; ++l) {
        const AirFilm& air = air_at(l);
        const double steep = saturation_slope(over_water, pressure[l], inverse[l]);
        const double above = std::max(0.0, temperature[l] - hottest_vapour);
        const double excess = pressure[l] + steep * above - air.vapour_pressure;
        const LatentHeat latent = latent_heat(air, {h[l], 0.0, film_slope[l]}, excess, steep);
        flux[l] += latent.flux;
        slope[l] += latent.slope;
    }
}

}  // namespace

}  // namespace diurna
