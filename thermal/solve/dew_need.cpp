#include "thermal/solve/dew_need.hpp"

#include <algorithm>

#include "materials/air/saturation.hpp"
#include "materials/base/units.hpp"
#include "thermal/surface/frost.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

namespace {

/// Which of a kind's times an instant is: columns of nodes have two stages a substep.
std::size_t time_of(const SolveState& solve, const Kind& kind, std::size_t i) {
    if (kind.times == solve.instant.size()) return i;
    const std::size_t stages = kind.times / solve.steps();
    return i == 0 ? 0 : i * stages - 1;
}

}  // namespace

Dew dew_on(const SolveState& solve, const Kind& kind, const Block& block, std::size_t lane) {
    Dew dew;
    const double radiation = kind.column.surface.emissivity * stefan_boltzmann;
    for (std::size_t i = 0; i < solve.instant.size(); ++i) {
        const double t = solve.kelvin[i * solve.facets + block.facet[lane]];
        const std::size_t time = time_of(solve, kind, i);
        const AirFilm& low = kind.low(block, time).air;
        double slope;
        // Far from it, as most are, nothing need be known exactly.
        if (saturation_over_water(t - 1.5, slope) > low.vapour_pressure) continue;
        const AirFilm air =
            block.up.empty() ? low : air_between(low, kind.high(block, time).air, block.up[lane]);
        const Film film = film_of(air, block.natural[lane], t);
        const double heat = latent_heat_or_frost(air, film, 0.0, 0.0, t).flux;
        if (heat <= 0.0) continue;
        const double loses = film.h + film.rise + 4.0 * radiation * t * t * t;
        dew.most_warming = std::max(dew.most_warming, heat / loses);
        dew.gathered += solve.step * heat / heat_of_vapour(air.air_temperature, t);
    }
    return dew;
}

}  // namespace diurna
