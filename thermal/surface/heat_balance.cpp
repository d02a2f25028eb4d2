#include "thermal/surface/heat_balance.hpp"

#include "thermal/surface/surface_flux.hpp"

namespace diurna {

double HeatBalance::sum() const {
    return absorbed_solar + longwave_in + longwave_out + sensible + latent + internal + conducted;
}

HeatBalance HeatBalance::times(double share) const {
    return {.absorbed_solar = share * absorbed_solar,
            .longwave_in = share * longwave_in,
            .longwave_out = share * longwave_out,
            .sensible = share * sensible,
            .latent = share * latent,
            .internal = share * internal,
            .conducted = share * conducted};
}

HeatBalance heat_balance(const AirFilm& air, const NaturalFilm& natural, double emissivity,
                         const ArrivingHeat& arriving, double temperature) {
    // (T1) of docs/theory.md
    const Film film = film_of(air, natural, temperature);
    const DryLoss dry = dry_loss(air, film, emissivity * stefan_boltzmann, temperature);
    HeatBalance balance;
    balance.absorbed_solar = arriving.absorbed_solar;
    balance.longwave_in = emissivity * arriving.longwave;
    balance.longwave_out = -dry.emitted;
    balance.sensible = -dry.sensible;
    if (air.wetness > 0.0) balance.latent = latent_heat(air, film, temperature).flux;
    balance.internal = arriving.internal;
    return balance;
}

}  // namespace diurna
