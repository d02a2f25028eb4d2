#include "thermal/solve/dew_need.hpp"

#include <algorithm>
#include <cmath>

#include "materials/air/saturation.hpp"
#include "materials/base/units.hpp"
#include "thermal/surface/frost.hpp"
#include "thermal/surface/stored_flux.hpp"
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

std::vector<double> warmest_dew(const SolveState& solve, const Kind& kind, const Block& block) {
    std::vector<double> warmest;
    for (std::size_t i = 0; i < solve.instant.size(); ++i) {
        const double e = kind.low(block, time_of(solve, kind, i)).air.vapour_pressure;
        // Of p₃ exp(a (T − T₃) / (T − b)) = e.
        const double x = std::log(std::max(e, 1e-3) / triple_point_pressure);
        const double dew_point =
            (over_water.a * triple_point - over_water.b * x) / (over_water.a - x);
        warmest.push_back(dew_point + 1.5);
    }
    return warmest;
}

Dew dew_on(const SolveState& solve, const Kind& kind, const Block& block, std::size_t lane,
           const std::vector<double>& warmest) {
    // An hour's dew counts, not that of ten minutes.
    const std::size_t stride = solve.options.quick ? 3 : 1;
    Dew dew;
    std::vector<float> kelvin(solve.kelvin.slots());
    solve.kelvin.get(block.facet[lane], kelvin.data());
    const NaturalFilm natural = natural_film_of(solve, block.facet[lane]);
    const double radiation = kind.column.surface.emissivity * stefan_boltzmann;
    for (std::size_t i = 0; i < solve.instant.size(); i += stride) {
        const double t = kelvin[i];
        // Far from it, as most are, nothing need be known exactly.
        if (t > warmest[i]) continue;
        const std::size_t time = time_of(solve, kind, i);
        const AirFilm& low = kind.low(block, time).air;
        double slope, vapour = low.vapour_pressure;
        if (!block.up.empty()) {
            const double high = kind.high(block, time).air.vapour_pressure;
            vapour = high + (1.0 - block.up[lane]) * (vapour - high);
        }
        if (saturation_over_frost(t, slope) > vapour) continue;
        const AirFilm air =
            block.up.empty() ? low : air_between(low, kind.high(block, time).air, block.up[lane]);
        const Film film = film_of(air, natural, t);
        const double heat = latent_heat_or_frost(air, film, 0.0, 0.0, t).flux;
        if (heat <= 0.0) continue;
        const double loses = film.h + film.rise + 4.0 * radiation * t * t * t;
        dew.most_warming = std::max(dew.most_warming, heat / loses);
        dew.gathered += double(stride) * solve.step * heat / heat_of_vapour(air.air_temperature, t);
    }
    return dew;
}

}  // namespace diurna
