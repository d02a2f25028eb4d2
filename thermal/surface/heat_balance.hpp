#pragma once

#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// The terms of a surface's heat balance, positive towards the surface [W m⁻²].
struct HeatBalance {
    double absorbed_solar = 0.0;
    double longwave_in = 0.0;   // ε L_in, absorbed
    double longwave_out = 0.0;  // −ε σ T⁴
    double sensible = 0.0;
    double latent = 0.0;
    double internal = 0.0;
    double conducted = 0.0;  // from the ground below

    /// Zero for a massless surface; otherwise the storage of the surface's half cell.
    double sum() const;
    /// For a partly open face, averaged over its whole area: every term times the share.
    HeatBalance times(double share) const;
};

/// Heat input of a surface that does not depend on its temperature [W m⁻²].
struct ArrivingHeat {
    double absorbed_solar = 0.0;
    double longwave = 0.0;  // irradiance, before absorption
    double internal = 0.0;
};

/// All terms except conduction, for one facet.
HeatBalance heat_balance(const AirFilm& air, const NaturalFilm& natural, double emissivity,
                         const ArrivingHeat& arriving, double temperature);

}  // namespace diurna
