#pragma once

#include "thermal/surface/surface_conditions.hpp"

namespace diurna {

/// The film at which stable air transports most heat [W m⁻² K⁻¹]: for colder surfaces Louis's
/// film falls faster than the difference grows. Ground is stabilised by its heat capacity;
/// leaves and snow's skin have none and would jump between two temperatures, so their film is
/// limited. In the lee of objects it is less, as the wind is.
double fullest_film(const AirFilm& air, const NaturalFilm& own);
/// That over the neutral film, over such ground: neutral_film() times this and AirFilm's `least`.
double fullest_share(const AirFilm& air);

/// Leaves, or snow, that hide the ground, coupled to it by a skin's conductance [W m⁻² K⁻¹]: the
/// balance is that of the skin, and the ground receives the conducted heat.
SurfaceTerms skin_terms(const SurfaceConditions& conditions, double conductance,
                        double ground_temperature);

/// Leaves above, ground between, each with its own balance (after Norman, Kustas & Humes 1995):
/// both exposed to the sky by their share of the view from above, and exchanging with each other
/// over the leaves' share.
SurfaceTerms two_source_terms(const SurfaceConditions& conditions, const TwoSource& canopy,
                              double ground_temperature);

}  // namespace diurna
