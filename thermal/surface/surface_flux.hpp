#pragma once

#include "materials/base/units.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

// The balance of one face of a surface, written once: scalar code and the loops over lanes
// (thermal/kernels) call these. For loops: no call, no branch.

/// The film of a face: ground (Louis, or constant) or a plate (natural and forced convection).
template <bool Plate>
[[gnu::always_inline]] inline Film film_of(const AirFilm& air, NaturalFilm natural,
                                           double temperature) {
    return Plate ? plate_film(air, natural, temperature) : ground_film(air, temperature);
}
inline Film film_of(const AirFilm& air, NaturalFilm natural, double temperature) {
    return air.plate ? film_of<true>(air, natural, temperature)
                     : film_of<false>(air, natural, temperature);
}
/// Of a plate's other side: seen from there, up is down.
inline NaturalFilm turned_over(NaturalFilm natural) { return {natural.cold, natural.warm}; }

/// What a face sends away by radiation and to the air [W m⁻²], and −d/dT of both [W m⁻² K⁻¹].
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
template <bool Plate, bool Wet>
[[gnu::always_inline]] inline SurfaceFlux surface_flux(const AirFilm& air, NaturalFilm natural,
                                                       double radiation, double heat,
                                                       double temperature) {
    const Film film = film_of<Plate>(air, natural, temperature);
    const DryLoss dry = dry_loss(air, film, radiation, temperature);
    SurfaceFlux into{heat - dry.emitted - dry.sensible, -dry.slope};
    if (Wet) {
        const LatentHeat latent = latent_heat(air, film, temperature);
        into.flux += latent.flux;
        into.slope += latent.slope;
    }
    return into;
}

/// [W m⁻²] that a plate's back absorbs among surroundings as warm as the air.
inline double absorbed_of_air(const AirFilm& air, double emissivity) {
    return emissivity * stefan_boltzmann * power4(air.air_temperature);
}
/// What a plate's back has to do with.
struct BackFace {
    double emissivity;
    double arriving;   // absorbed sun and longwave [W m⁻²]
    bool wet = false;  // evaporates as the front does
};
/// Heat into it.
///
/// front  the natural film of the other side
inline SurfaceFlux back_flux(const AirFilm& air, NaturalFilm front, const BackFace& back,
                             double temperature) {
    const double radiation = back.emissivity * stefan_boltzmann;
    const auto flux = air.plate
                          ? (back.wet ? surface_flux<true, true> : surface_flux<true, false>)
                          : (back.wet ? surface_flux<false, true> : surface_flux<false, false>);
    return flux(air, turned_over(front), radiation, back.arriving, temperature);
}

}  // namespace diurna
