#pragma once

#include "materials/base/units.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

// The balance of one face of a surface, for both scalar code and the loops over lanes
// (thermal/kernels): no call, no branch.

/// [W m⁻² K⁻¹] The film over ground as warm as the air; own: facet_film(), with the share of the
/// wind
[[gnu::always_inline]] inline double neutral_film(const AirFilm& air, const NaturalFilm& own) {
    return air.kind == FilmKind::sheltered_ground ? air.neutral * own.laminar : air.neutral;
}

/// The film of a face.
template <FilmKind Kind>
[[gnu::always_inline]] inline Film film_of(const AirFilm& air, const NaturalFilm& own,
                                           double temperature) {
    if (Kind == FilmKind::ground) return ground_film(air, temperature);
    if (Kind == FilmKind::sheltered_ground) {
        // Wind reduced by facet_film's share.
        return ground_film({.air_temperature = air.air_temperature,
                            .neutral = air.neutral * own.laminar,
                            .instability = air.instability * own.turbulent,
                            .a = air.a,
                            .c = air.c,
                            .s = air.s,
                            .least = air.least,
                            .heat_capacity = air.heat_capacity,
                            .vapour_pressure = air.vapour_pressure,
                            .latent = air.latent,
                            .resistance = air.resistance,
                            .wetness = air.wetness,
                            .kind = air.kind,
                            .plate = {}},
                           temperature);
    }
    const double excess = temperature - air.air_temperature;
    return Kind == FilmKind::wall ? wall_film(air.plate, own, excess)
                                  : body_film(air.plate, own, excess);
}

/// Calls `call` as a template of the film's kind and of whether the surface is wet.
template <class Call>
auto by_kind(FilmKind kind, bool wet, const Call& call) {
    const auto of = [&]<FilmKind Kind>() {
        return wet ? call.template operator()<Kind, true>()
                   : call.template operator()<Kind, false>();
    };
    switch (kind) {
        case FilmKind::ground:
            break;
        case FilmKind::sheltered_ground:
            return of.template operator()<FilmKind::sheltered_ground>();
        case FilmKind::wall:
            return of.template operator()<FilmKind::wall>();
        case FilmKind::body:
            return of.template operator()<FilmKind::body>();
    }
    return of.template operator()<FilmKind::ground>();
}
inline Film film_of(const AirFilm& air, const NaturalFilm& own, double temperature) {
    return by_kind(air.kind, false,
                   [&]<FilmKind Kind, bool>() { return film_of<Kind>(air, own, temperature); });
}
/// The film of a plate's other side, whose normal is reversed.
inline NaturalFilm turned_over(const NaturalFilm& own) {
    NaturalFilm other = own;
    other.side = -own.side;
    return other;
}

/// Emission and convection of a face [W m⁻²], and −d/dT of both [W m⁻² K⁻¹].
///
/// radiation  ε σ [W m⁻² K⁻⁴]
struct DryLoss {
    double emitted, sensible, slope;
};
[[gnu::always_inline]] inline DryLoss dry_loss(const AirFilm& air, const Film& film,
                                               double radiation, double temperature) {
    const double cube = radiation * temperature * temperature * temperature;
    return {cube * temperature, film.h * (temperature - air.air_temperature),
            4.0 * cube + film.h + film.rise};
}

/// Heat into a face from above [W m⁻²], and d/dT:
///
///     heat − ε σ T⁴ − h (T − T_air) + latent(T)
///
/// heat  absorbed sun and longwave, internal [W m⁻²]
struct SurfaceFlux {
    double flux, slope;
};
template <FilmKind Kind, bool Wet>
[[gnu::always_inline]] inline SurfaceFlux surface_flux(const AirFilm& air,
                                                       const NaturalFilm& natural, double radiation,
                                                       double heat, double temperature) {
    const Film film = film_of<Kind>(air, natural, temperature);
    const DryLoss dry = dry_loss(air, film, radiation, temperature);
    SurfaceFlux into{heat - dry.emitted - dry.sensible, -dry.slope};
    if (Wet) {
        const LatentHeat latent = latent_heat(air, film, temperature);
        into.flux += latent.flux;
        into.slope += latent.slope;
    }
    return into;
}

/// [W m⁻²] absorbed by a plate's back from surroundings at the air's temperature.
inline double absorbed_of_air(const AirFilm& air, double emissivity) {
    return emissivity * stefan_boltzmann * power4(air.air_temperature);
}
/// Conditions of a plate's back.
struct BackFace {
    double emissivity;
    double arriving;   // absorbed sun and longwave [W m⁻²]
    bool wet = false;  // evaporates as the front does
};
/// Heat flux into the back.
///
/// front  the natural film of the other side
inline SurfaceFlux back_flux(const AirFilm& air, const NaturalFilm& front, const BackFace& back,
                             double temperature) {
    const double radiation = back.emissivity * stefan_boltzmann;
    const NaturalFilm own = turned_over(front);
    return by_kind(air.kind, back.wet, [&]<FilmKind Kind, bool Wet>() {
        return surface_flux<Kind, Wet>(air, own, radiation, back.arriving, temperature);
    });
}

}  // namespace diurna
