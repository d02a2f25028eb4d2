#pragma once

#include "thermal/surface/surface_conditions.hpp"

namespace diurna {

/// The film at which stable air carries most heat [W m⁻² K⁻¹]: colder, Louis's film falls faster
/// than the difference grows. Ground has its own heat to hold it; leaves and a snow's skin have
/// none and would jump between two temperatures, so their film falls no further.
double fullest_film(const AirFilm& air);
/// Of that at neutrality, over ground as rough: AirFilm's `neutral` times this and `least`.
double fullest_share(const AirFilm& air);

/// Leaves, or snow, that hide the ground, joined to it by a skin's conductance [W m⁻² K⁻¹]: the
/// balance is the skin's, and the ground gets what the skin conducts.
SurfaceTerms skin_terms(const SurfaceConditions& conditions, double conductance,
                        double ground_temperature);

/// Leaves above, ground between, each with a balance of its own (after Norman, Kustas & Humes
/// 1995): both open to the sky by their share of the view from above, and facing one another over
/// the leaves' share.
SurfaceTerms two_source_terms(const SurfaceConditions& conditions, const TwoSource& canopy,
                              double ground_temperature);

}  // namespace diurna
