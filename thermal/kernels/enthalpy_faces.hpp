#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "materials/air/saturation.hpp"
#include "materials/base/fast_exp.hpp"
#include "materials/base/units.hpp"
#include "thermal/kernels/enthalpy_laws.hpp"
#include "thermal/surface/stored_flux.hpp"
#include "thermal/surface/surface_flux.hpp"

// The ends of columns with freezing water, lane by lane: the skin with its cover, and the flux from
// below.

namespace diurna {

namespace {

/// Films and dry losses of skins, and the vapour above them [lane]: in short loops, as the compiler
/// does not vectorise long ones.
struct SkinState {
    alignas(64) double h[W], steep[W], dry[W], dry_slope[W];
    alignas(64) double pressure[W], pressure_slope[W];  // of saturation [Pa]
};
template <FilmKind Kind>
void films_of(const EnthalpySurface& s, const double* temperature, SkinState& skin) {
    // A copy for branches between scalars: no store through a pointer can change it.
    const std::conditional_t<on_ground<Kind>, const LaneAir&, LaneAir> air_at = *s.air;
    const double radiation = s.emissivity * stefan_boltzmann;
    const double* const least = s.least_film;
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const AirFilm& air = air_at(l);
        const double t = temperature[l], floor = least[l];
        Film film = film_of<Kind>(air, s.natural[l], t);
        const double holds = film.h < floor ? 0.0 : 1.0;  // the minimum film of a skin over snow
        film.h = std::max(film.h, floor);
        film.rise *= holds;
        const DryLoss dry = dry_loss(air, film, radiation, t);
        skin.h[l] = film.h;
        skin.steep[l] = holds * film.slope;
        skin.dry[l] = dry.emitted + dry.sensible;
        skin.dry_slope[l] = dry.slope;
    }
}
/// saturation_over_frost of all lanes.
void saturate(const double* temperature, SkinState& skin) {
    alignas(64) double a[W], rest[W], scale[W], factor[W];
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const bool ice = temperature[l] < triple_point;
        const double b = ice ? over_ice.b : over_water.b;
        a[l] = ice ? over_ice.a : over_water.a;
        const double t = std::min(std::max(temperature[l], coldest_vapour), hottest_vapour);
        const double inverse = 1.0 / (t - b);
        const ExpParts parts = exp_parts(a[l] * (t - triple_point) * inverse);
        rest[l] = parts.rest;
        scale[l] = parts.scale;
        factor[l] = a[l] * (triple_point - b) * inverse * inverse;
    }
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const double pressure = triple_point_pressure * scale[l] * exp_series(rest[l]);
        const double slope = pressure * factor[l];
        skin.pressure[l] = pressure + slope * std::max(0.0, temperature[l] - hottest_vapour);
        skin.pressure_slope[l] = slope;
    }
}
template <FilmKind Kind>
void skins_at(const EnthalpySurface& s, const double* temperature, SkinState& skin) {
    films_of<Kind>(s, temperature, skin);
    saturate(temperature, skin);
}
void skins_of(const EnthalpySurface& s, const double* temperature, SkinState& skin) {
    by_kind(s.air->kind, false,
            [&]<FilmKind Kind, bool>() { skins_at<Kind>(s, temperature, skin); });
}
/// frost_vapour of all lanes: pressure minus the air's, and the heat carried by vapour.
struct LaneVapour {
    alignas(64) double excess[W], heat[W], heat_slope[W];
};
void vapour_over(const EnthalpySurface& s, const SkinState& skin, const double* temperature,
                 double carries, LaneVapour& v) {
    const LaneAir& air = *s.air;
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const double vapour = carries * air.latent[l], more = air.of_ice[l] - 1.0;
        const double cold = (zero_celsius - temperature[l]) * (1.0 / freezing_span);
        const double above = cold > 0.0 ? cold : 0.0, frozen = above < 1.0 ? above : 1.0;
        const double blends = above - frozen == 0.0 ? 1.0 / freezing_span : 0.0;
        v.excess[l] = skin.pressure[l] - air.vapour_pressure[l];
        v.heat[l] = vapour * (1.0 + frozen * more);
        v.heat_slope[l] = cold > 0.0 ? -blends * vapour * more : 0.0;
    }
}

/// The balance of the skins at temperatures [lane].
void balance_at(const EnthalpySurface& s, const double* temperature, double* flux, double* slope) {
    SkinState skin;
    skins_of(s, temperature, skin);
    const LaneAir& air = *s.air;
    const double wetness = air.wetness, resistance = air.resistance;
    const double *const share = s.wet_share, *const film = s.phase_film;
    const double *const frost = s.frost_heat, *const water = s.water_heat, *const heat = s.heat;
    alignas(64) double latent[W], latent_slope[W];
    LaneVapour v;
    vapour_over(s, skin, temperature, s.evaporates ? 1.0 : 0.0, v);
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        // stored_latent: from the wet share freely, from the rest through its resistance.
        const double h = skin.h[l], capacity = air.heat_capacity[l], wet = share[l];
        const double excess = v.excess[l], carried = v.heat[l];
        const double drying = excess > 0.0 ? 1.0 : 0.0;
        const double held = (1.0 - wet) * (1.0 - drying * (1.0 - wetness));
        const double free_series = 1.0 / capacity;
        const double series = 1.0 / (capacity + drying * resistance * h);
        const double conductance = h * (wet * free_series + held * series);
        const double steeper =
            capacity * skin.steep[l] * (wet * free_series * free_series + held * series * series);
        latent[l] = -carried * conductance * excess;
        latent_slope[l] = -carried * (conductance * skin.pressure_slope[l] + steeper * excess) -
                          v.heat_slope[l] * conductance * excess;
    }
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const double k = film[l], most = frost[l], least = -water[l];
        const double free = k * (temperature[l] - zero_celsius);
        const double taken = std::min(std::max(free, least), most);
        const double turning = (free > least) & (free < most) ? k : 0.0;
        flux[l] = heat[l] - skin.dry[l] + latent[l] - taken;
        slope[l] = latent_slope[l] - turning - skin.dry_slope[l];
    }
}

void store_at(const EnthalpySurface& s, const double* temperature, double* wet_latent,
              double* melt) {
    SkinState skin;
    skins_of(s, temperature, skin);
    const LaneAir& air = *s.air;
    const double *const film = s.phase_film, *const frost = s.frost_heat,
                        *const water = s.water_heat;
    LaneVapour v;
    vapour_over(s, skin, temperature, 1.0, v);
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        wet_latent[l] = -v.heat[l] * skin.h[l] / air.heat_capacity[l] * v.excess[l];
        const double most = frost[l], least = -water[l];
        const double free = film[l] * (temperature[l] - zero_celsius);
        melt[l] = -std::min(std::max(free, least), most);
    }
}

/// Flux into the ground at its temperatures [lane]: the skin's balance, through the snow
/// cover.
///
/// settled  [K] the skin's last correction, which is applied: the error is of second order
void into_ground(const EnthalpySurface& s, const double* ground, double settled, double* skin,
                 double* flux, double* slope) {
    if (!s.cover) {
        std::copy_n(ground, W, skin);
        balance_at(s, ground, flux, slope);
        return;
    }
    alignas(64) double low[W], high[W], step[W];
    std::fill_n(low, W, coldest_node);
    std::fill_n(high, W, hottest_node);
    for (int i = 0; i < 120; ++i) {
        double worst = 0.0;
        balance_at(s, skin, flux, slope);
#pragma omp simd reduction(max : worst)
        for (std::size_t l = 0; l < W; ++l) {
            const double excess = flux[l] - s.cover[l] * (skin[l] - ground[l]);
            low[l] = excess > 0.0 ? skin[l] : low[l];
            high[l] = excess > 0.0 ? high[l] : skin[l];
            const double newton = excess / (s.cover[l] - slope[l]);
            double next = skin[l] + newton;
            const bool inside = next > low[l] && next < high[l] && i < 50;
            next = inside || std::abs(newton) < 1e-11 ? next : 0.5 * (low[l] + high[l]);
            step[l] = std::abs(next - skin[l]);
            worst = std::max(worst, step[l]);
            flux[l] += slope[l] * (next - skin[l]);
            skin[l] = next;
        }
        if (worst < settled) break;
    }
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const double g = s.cover[l];  // instead of g (skin − ground), which loses digits
        slope[l] = g * (g / (g - slope[l]) - 1.0);
    }
}

/// Losses and gains of plates' backs at temperatures [lane].
template <FilmKind Kind>
void back_of_plate(const EnthalpySurface& s, const double* t, double* flux, double* slope) {
    const std::conditional_t<on_ground<Kind>, const LaneAir&, LaneAir> air_at = *s.air;
    const double radiation = s.back_emissivity * stefan_boltzmann;
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const AirFilm& air = air_at(l);
        const NaturalFilm& front = s.natural[l];  // reversed
        const NaturalFilm own{.side = -front.side,
                              .quarter = front.quarter,
                              .third = front.third,
                              .conduct = front.conduct,
                              .sixth = front.sixth,
                              .laminar = front.laminar,
                              .turbulent = front.turbulent,
                              .edge = front.edge};
        const SurfaceFlux back = surface_flux<Kind, false>(air, own, radiation, 0.0, t[l]);
        flux[l] = back.flux + s.behind[l];
        slope[l] = back.slope;
    }
}
/// Flux into the last nodes from below, at temperatures [lane].
void from_below(const EnthalpySurface& s, const EnthalpyColumn& c, const double* t, double* flux,
                double* slope) {
    if (s.behind) {
        by_kind(s.air->kind, false,
                [&]<FilmKind Kind, bool>() { back_of_plate<Kind>(s, t, flux, slope); });
    } else if (c.below_is_link) {
        const EnthalpyLink link = c.below_link;
        const double there = potential_of(link, c.below_temperature);
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            flux[l] = link.per_width * (there - potential_of(link, t[l]));
            slope[l] = -link.per_width * conductivity_of(link, t[l]);
        }
    } else {
        const double into = c.below_flux, k = c.below_conductance, there = c.below_temperature;
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            flux[l] = into + k * (there - t[l]);
            slope[l] = -k;
        }
    }
}

}  // namespace

}  // namespace diurna
