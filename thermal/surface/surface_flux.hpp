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
/// Heat into a plate's back, dry.
///
/// front     the natural film of the other side
/// arriving  absorbed sun and longwave [W m⁻²]
inline SurfaceFlux back_flux(const AirFilm& air, NaturalFilm front, double emissivity,
                             double arriving, double temperature) {
    const double radiation = emissivity * stefan_boltzmann;
    return air.plate ? surface_flux<true, false>(air, turned_over(front), radiation, arriving,
                                                 temperature)
                     : surface_flux<false, false>(air, turned_over(front), radiation, arriving,
                                                  temperature);
}

}  // namespace diurna
