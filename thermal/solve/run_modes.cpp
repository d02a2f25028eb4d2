#include "thermal/solve/run_block.hpp"

#include <algorithm>
#include <cmath>

#include "thermal/solve/block_heat.hpp"

namespace diurna {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Strided = Eigen::Map<Rows, 0, Eigen::OuterStride<>>;

}  // namespace

void run_modes(SolveState& solve, const Level& level, Block& block) {
    const Kind& kind = level.kind[block.material];
    const ModeColumn& modes = *kind.modes;
    const ModeStep& step = modes.step;
    const int substeps = kind.column.substeps;
    const std::size_t count = block.facet.size();
    const double emissivity = kind.column.surface.emissivity;
    const auto n = modes.reduced.modes();
    const Eigen::OuterStride<> stride{Eigen::Index(block.stride)};
    ModeBatch batch;
    batch.resize(std::size_t(n), count);
    const std::size_t filled = batch.units() * lanes;
    std::copy(block.natural.begin(), block.natural.end(), batch.natural.begin());
    Strided start(block.start.data(), n, Eigen::Index(count), stride);
    const auto of_unit = [&](std::size_t u) {
        const std::size_t first = u * lanes, facets = std::min(lanes, count - first);
        return Strided(batch.state.data() + first * std::size_t(n), n, Eigen::Index(facets),
                       Eigen::OuterStride<>{Eigen::Index(lanes)});
    };
    for (std::size_t u = 0; u < batch.units(); ++u) {
        Strided state = of_unit(u);
        state.noalias() =
            modes.closed.turn.transpose() * start.middleCols(Eigen::Index(u * lanes), state.cols());
    }
    block.slope.assign(kind.forcing.size(), 0.0);
    block.steepness.assign(block.stride, 0.0);
    StepRecord record;

    BlockHeat heat(solve, level, block, filled);
    begin_modes(step, kind.forcing[0].air, heat.at_end, emissivity, batch);
    for (std::size_t l = 0; l < count; ++l) {
        solve.kelvin[block.facet[l]] = float(batch.temperature[l]);
    }
    std::size_t at = 0;
    for (std::size_t i = level.stride; i <= solve.steps(); i += level.stride) {
        heat.begin_step(i);
        for (int s = 0; s < substeps; ++s) {
            ++at;
            const StageForcing& forcing = kind.forcing[at];
            heat.begin_substep(s, forcing.sky_longwave);
            advance_modes(step,
                          {.air_before = kind.forcing[at - 1].air,
                           .air = forcing.air,
                           .heat_before = heat.at_start,
                           .heat = heat.at_end,
                           .jumps = heat.jumps},
                          emissivity, batch, record);
            block.slope[at] = record.slope[0];
            for (std::size_t l = 0; l < count; ++l) block.steepness[l] += batch.slope[l];
        }
        heat.end_step();
        float* row = solve.kelvin.data() + i * solve.facets;
        for (std::size_t l = 0; l < count; ++l) row[block.facet[l]] = float(batch.temperature[l]);
    }
    end_modes(step, batch);
    block.slope[0] = block.slope[at];  // of a span that repeats
    block.record = record;
    block.change.resize(block.start.size());
    Strided change(block.change.data(), n, Eigen::Index(count), stride);
    for (std::size_t u = 0; u < batch.units(); ++u) {
        const Strided state = of_unit(u);
        change.middleCols(Eigen::Index(u * lanes), state.cols()).noalias() =
            modes.closed.turn * state;
    }
    change -= start;
    block.residual = (modes.probe * change).cwiseAbs().maxCoeff();
    block.heat_change = 0.0;
}

}  // namespace diurna
