#include <algorithm>
#include <cmath>

#include "thermal/solve/block_heat.hpp"
#include "thermal/solve/heat_record.hpp"
#include "thermal/solve/run_block.hpp"

namespace diurna {

namespace {

Eigen::Index lanes_of_unit(const ModeBatch& batch, std::size_t unit) {
    return Eigen::Index(std::min(lanes, batch.count - unit * lanes));
}
/// The states of a batch's unit, of its lanes that are wanted.
BlockStates unit_states(ModeBatch& batch, std::size_t modes, std::size_t unit) {
    return {batch.state.data() + unit * lanes * modes, Eigen::Index(modes),
            lanes_of_unit(batch, unit), Eigen::OuterStride<>(Eigen::Index(lanes))};
}
BlockStates block_states(std::vector<double>& states, std::size_t modes, const Block& block) {
    return {states.data(), Eigen::Index(modes), Eigen::Index(block.facet.size()),
            Eigen::OuterStride<>(Eigen::Index(block.stride))};
}

/// The block's start in the modes of the closed column.
ModeBatch batch_of(const SolveState& solve, const ModeColumn& modes, Block& block) {
    const auto n = std::size_t(modes.reduced.modes());
    ModeBatch batch;
    batch.resize(n, block.facet.size());
    const std::vector<NaturalFilm> natural = natural_films(solve, block);
    std::copy(natural.begin(), natural.end(), batch.natural.begin());
    const BlockStates start = block_states(block.start, n, block);
    for (std::size_t u = 0; u < batch.units(); ++u) {
        BlockStates state = unit_states(batch, n, u);
        state.noalias() =
            modes.closed.turn.transpose() * start.middleCols(Eigen::Index(u * lanes), state.cols());
    }
    return batch;
}

/// What the span has changed, in the modes of the open column.
void compare_with_start(const ModeColumn& modes, ModeBatch& batch, Block& block) {
    const auto n = std::size_t(modes.reduced.modes());
    block.change.resize(block.start.size());
    Eigen::MatrixXd change(Eigen::Index(n), Eigen::Index(block.facet.size()));
    for (std::size_t u = 0; u < batch.units(); ++u) {
        const BlockStates state = unit_states(batch, n, u);
        change.middleCols(Eigen::Index(u * lanes), state.cols()).noalias() =
            modes.closed.turn * state;
    }
    change -= block_states(block.start, n, block);
    BlockChanges(block.change.data(), change.rows(), change.cols(),
                 Eigen::OuterStride<>(Eigen::Index(block.stride))) = change.cast<float>();
    block.residual = (modes.probe * change).cwiseAbs().maxCoeff();
}

/// What the columns take in at a step's end: the drive less the film's part and what comes from
/// below.
void record_modes(SolveState& solve, const Kind& kind, const ModeBatch& batch, const Block& block,
                  std::size_t i, const BlockSurfaces& surfaces) {
    if (!solve.record) return;
    const ModeStep& step = kind.modes->step;
    double taken[mode_lanes];
    for (std::size_t l = 0; l < batch.count; ++l) {
        taken[l] =
            batch.drive[l] - step.film * (batch.temperature[l] - step.reference) - step.flux_below;
    }
    record_block(solve, block, kind, i,
                 {surfaces.air, surfaces.heat, surfaces.temperature, {taken, batch.count}});
}

}  // namespace

void run_modes(SolveState& solve, const Level& level, Block& block) {
    const Kind& kind = level.kind[block.material];
    const ModeStep& step = kind.modes->step;
    const double emissivity = kind.column.surface.emissivity;
    ModeBatch batch = batch_of(solve, *kind.modes, block);
    block.slope.assign(kind.times, 0.0);
    block.steepness.assign(block.stride, 0.0);
    block.record = {};

    BlockHeat heat(solve, level, block, batch.units() * lanes);
    begin_modes(step, kind.over(block, 0), heat.at_end, emissivity, batch);
    KelvinRecord kelvin(solve, block);
    kelvin.put(batch.temperature.data());
    record_modes(solve, kind, batch, block, 0,
                 {kind.over(block, 0), heat.at_end, batch.temperature.data()});
    std::size_t at = 0;
    for (std::size_t i = level.stride; i <= solve.steps(); i += level.stride) {
        heat.begin_step(i);
        for (int s = 0; s < kind.column.substeps; ++s) {
            ++at;
            heat.begin_substep(s, at);
            advance_modes(step,
                          {.air_before = kind.over(block, at - 1),
                           .air = kind.over(block, at),
                           .heat_before = heat.at_start,
                           .heat = heat.at_end,
                           .jumps = heat.jumps},
                          emissivity, batch, block.record);
            block.slope[at] = block.record.slope[0];
            for (std::size_t l = 0; l < batch.count; ++l) block.steepness[l] += batch.slope[l];
        }
        heat.end_step();
        kelvin.put(batch.temperature.data());
        record_modes(solve, kind, batch, block, i,
                     {kind.over(block, at), heat.at_end, batch.temperature.data()});
    }
    end_modes(step, batch);
    block.slope[0] = block.slope[at];  // of a span that repeats
    compare_with_start(*kind.modes, batch, block);
}

}  // namespace diurna
