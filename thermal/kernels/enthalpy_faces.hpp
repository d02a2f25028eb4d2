#pragma once

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/kernels/enthalpy_laws.hpp"
#include "thermal/surface/frost.hpp"
#include "thermal/surface/stored_flux.hpp"
#include "thermal/surface/surface_flux.hpp"

// The ends of columns whose water freezes, lane by lane: the skin with what lies on it, and what
// comes from below.

namespace diurna {

namespace {

template <FilmKind Kind>
[[gnu::always_inline]] inline Film skin_film(const EnthalpySurface& s, const AirFilm& air,
                                             std::size_t l, double t) {
    Film film = film_of<Kind>(air, s.natural[l], t);
    const bool fallen = film.h < s.least_film[l];
    film.h = fallen ? s.least_film[l] : film.h;
    film.rise = fallen ? 0.0 : film.rise;
    film.slope = fallen ? 0.0 : film.slope;
    return film;
}

/// The balance of the skins at temperatures [lane].
template <FilmKind Kind>
void balance_of(const EnthalpySurface& s, const double* temperature, double* flux, double* slope) {
    const AirFilm air = s.air;
    const double radiation = s.emissivity * stefan_boltzmann;
    const double of_ice = latent_heat_of_sublimation(air.air_temperature) /
                          latent_heat_of_vaporisation(air.air_temperature);
    const double vapour = s.evaporates ? air.latent : 0.0;
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const double t = temperature[l];
        const Film film = skin_film<Kind>(s, air, l, t);
        const DryLoss dry = dry_loss(air, film, radiation, t);
        const SurfaceFlux wet = stored_latent(air, film, vapour, of_ice, s.wet_share[l], t);
        const SurfaceFlux melt = melting_flux(s.phase_film[l], s.frost_heat[l], s.water_heat[l], t);
        flux[l] = s.heat[l] - dry.emitted - dry.sensible + wet.flux + melt.flux;
        slope[l] = wet.slope + melt.slope - dry.slope;
    }
}
void balance_at(const EnthalpySurface& s, const double* temperature, double* flux, double* slope) {
    by_kind(s.air.kind, false,
            [&]<FilmKind Kind, bool>() { balance_of<Kind>(s, temperature, flux, slope); });
}

template <FilmKind Kind>
void store_of(const EnthalpySurface& s, const double* skin, double* wet_latent, double* melt) {
    const AirFilm air = s.air;
    const double of_ice = latent_heat_of_sublimation(air.air_temperature) /
                          latent_heat_of_vaporisation(air.air_temperature);
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const double t = skin[l];
        const Film film = skin_film<Kind>(s, air, l, t);
        const FrostVapour vapour = frost_vapour(air, air.latent, of_ice, t);
        wet_latent[l] = latent_of(air, film, vapour, 1.0, 0.0).flux;
        melt[l] = melting_flux(s.phase_film[l], s.frost_heat[l], s.water_heat[l], t).flux;
    }
}
void store_at(const EnthalpySurface& s, const double* skin, double* wet_latent, double* melt) {
    by_kind(s.air.kind, false,
            [&]<FilmKind Kind, bool>() { store_of<Kind>(s, skin, wet_latent, melt); });
}

/// What reaches the ground at its temperatures [lane]: the skin's balance, through the snow that
/// lies on it.
void into_ground(const EnthalpySurface& s, const double* ground, double* skin, double* flux,
                 double* slope) {
    if (!s.cover) {
        std::copy_n(ground, W, skin);
        balance_at(s, ground, flux, slope);
        return;
    }
    double low[W], high[W], step[W];
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
        if (worst < 1e-8) break;
    }
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const double g = s.cover[l];  // whose g (skin − ground) would have lost digits
        slope[l] = g * (g / (g - slope[l]) - 1.0);
    }
}

/// Into the last nodes from below, at temperatures [lane].
void from_below(const EnthalpySurface& s, const EnthalpyColumn& c, const double* t, double* flux,
                double* slope) {
    if (s.behind) {
        const BackFace face{s.back_emissivity, 0.0, false};
        for (std::size_t l = 0; l < W; ++l) {
            const SurfaceFlux back = back_flux(s.air, s.natural[l], face, t[l]);
            flux[l] = back.flux + s.behind[l];
            slope[l] = back.slope;
        }
    } else if (c.below_is_link) {
        const double there = potential_of(c.below_link, c.below_temperature);
        for (std::size_t l = 0; l < W; ++l) {
            flux[l] = c.below_link.per_width * (there - potential_of(c.below_link, t[l]));
            slope[l] = -c.below_link.per_width * conductivity_of(c.below_link, t[l]);
        }
    } else {
        for (std::size_t l = 0; l < W; ++l) {
            flux[l] = c.below_flux + c.below_conductance * (c.below_temperature - t[l]);
            slope[l] = -c.below_conductance;
        }
    }
}

}  // namespace

}  // namespace diurna
