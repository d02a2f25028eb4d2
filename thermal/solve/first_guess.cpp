#include "thermal/solve/first_guess.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "thermal/solve/time_level.hpp"
#include "thermal/steppers/layered_step.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

Eigen::VectorXd steady_states(const Kind& kind) {
    if (!kind.modes) {
        const std::vector<double> share = steady_column(kind.column.grid).share;
        return Eigen::VectorXd::Map(share.data(), Eigen::Index(share.size()));
    }
    const ReducedColumn& column = kind.modes->reduced;
    const ClosedColumn closed = close_column(column, 1.0);
    // Steady conductance to what lies below: the modes' own, so that they stay where they are.
    const bool open = column.below > 0.0;
    const double conductance = open ? 1.0 / impedance(column, 0.0).real() : 0.0;
    return closed.turn *
           ((conductance + closed.film) * closed.surface.cwiseQuotient(closed.rate)).eval();
}

namespace {

void settle_block(SolveState& solve, const Level& level, Block& block) {
    const Kind& kind = level.kind[block.material];
    const std::size_t count = block.facet.size();
    AirFilm mean = kind.low(block, 0).air;
    double sky = 0.0, sums[4] = {};
    for (std::size_t time = 0; time < kind.times; ++time) {
        const StageForcing forcing = kind.middle(block, time);
        sky += forcing.sky_longwave;
        sums[0] += forcing.air.air_temperature;
        sums[1] += forcing.air.neutral;
        sums[2] += forcing.air.instability;
        sums[3] += forcing.air.vapour_pressure;
        mean.plate = air_between(mean, forcing.air, 1.0 / (double(time) + 1.0)).plate;
    }
    const double n = double(kind.times);
    mean.air_temperature = sums[0] / n;
    mean.neutral = sums[1] / n;
    mean.instability = sums[2] / n;
    mean.vapour_pressure = sums[3] / n;
    std::vector<double> heat(block.stride, kind.column.surface.emissivity * sky / n),
        at(block.stride);
    FaceHeat fronts(solve, block, block.facet), backs(solve, block, block.behind);
    for (std::size_t i = 0; i < solve.steps(); ++i) {
        fronts.at(front_of(solve, block, kind, i), i, at.data());
        for (std::size_t l = 0; l < count; ++l) heat[l] += at[l] / double(solve.steps());
        if (block.behind.empty()) continue;
        // As if it fell on the front, beyond what the grid's film behind gives.
        const BlockFace back = back_of(solve, block);
        const double rest =
            back.emissivity * sky / n - absorbed_of_air(mean, kind.column.surface.back->emissivity);
        backs.at(back, i, at.data());
        for (std::size_t l = 0; l < count; ++l) heat[l] += (at[l] + rest) / double(solve.steps());
    }
    const Eigen::VectorXd steady = kind.modes ? steady_states(kind) : Eigen::VectorXd();
    const std::size_t states = kind.modes ? std::size_t(steady.size()) : kind.column.grid.size();
    block.start.assign(states * block.stride, 0.0);
    block.film = 0.0;
    const std::vector<NaturalFilm> natural = natural_films(solve, block);
    for (std::size_t first = 0; first < count; first += lanes) {
        LayeredBatch batch;
        batch.resize(kind.column.grid.size(), std::min(lanes, count - first));
        std::copy_n(natural.begin() + std::ptrdiff_t(first), batch.count, batch.natural.begin());
        block.film += settle(kind.column, mean, heat.data() + first, batch);
        for (std::size_t l = 0; l < batch.count; ++l) {
            const double t = batch.temperature[l];
            for (std::size_t m = 0; m < states; ++m) {
                block.start[m * block.stride + first + l] =
                    kind.modes ? steady[Eigen::Index(m)] * (t - kind.modes->reduced.reference)
                               : batch.state[m * lanes + l];
            }
            solve.kelvin.fill(block.facet[first + l], float(t));
            if (!block.behind.empty()) solve.kelvin.fill(block.behind[first + l], float(t));
        }
    }
}

}  // namespace

void settle(SolveState& solve, Level& level) {
    for_each_index(
        solve.block.size(), [&](std::size_t b) { settle_block(solve, level, solve.block[b]); }, 4);
    std::vector<double> film(level.kind.size());
    for (const Block& block : solve.block) film[block.material] += block.film;
    for (std::size_t k = 0; k < level.kind.size(); ++k) {
        Kind& kind = level.kind[k];
        const double front = film[k] / double(kind.facets);
        if (kind.modes) set_film(kind, front, level_step(solve, level));
        if (kind.plate) set_plate_films(kind, front, front, level_step(solve, level));
    }
}

}  // namespace diurna
