#include <algorithm>
#include <cmath>
#include <optional>

#include "thermal/solve/block_heat.hpp"
#include "thermal/solve/heat_record.hpp"
#include "thermal/solve/run_block.hpp"

namespace diurna {

namespace {

/// What the plates take in through their fronts at a step's end.
void record_plates(SolveState& solve, const Kind& kind, const PlateBatch& batch, const Block& block,
                   std::size_t i, const BlockSurfaces& surfaces) {
    if (!solve.record) return;
    const PlateStep& step = *kind.plate;
    double taken[lanes];
    for (std::size_t l = 0; l < batch.count; ++l) {
        taken[l] = batch.drive[0][l] - step.film[0] * (batch.temperature[0][l] - step.reference);
    }
    record_block(solve, block, kind, i,
                 {surfaces.air, surfaces.heat, surfaces.temperature, {taken, batch.count}});
    if (!block.behind.empty()) {
        record_backs(solve, block, i,
                     {surfaces.air, batch.behind, batch.temperature[1].data(), {}});
    }
}

}  // namespace

void run_plates(SolveState& solve, const Level& level, Block& block) {
    const Kind& kind = level.kind[block.material];
    const PlateStep& step = *kind.plate;
    const ThermalSurface& surface = kind.column.surface;
    const int substeps = kind.column.substeps;
    const std::size_t count = block.facet.size();
    const Eigen::OuterStride<> stride{Eigen::Index(lanes)};
    const auto n = Eigen::Index(step.modes()), facets = Eigen::Index(count);
    PlateBatch batch;
    batch.resize(step.modes(), count);
    const std::vector<NaturalFilm> natural = natural_films(solve, block);
    std::copy(natural.begin(), natural.end(), batch.natural.begin());
    const BlockStates start(block.start.data(), n, facets, stride);
    BlockStates state(batch.state.data(), n, facets, stride);
    state.noalias() = step.into * start;
    block.slope.assign(kind.times, 0.0);
    block.back_slope.assign(kind.times, 0.0);
    block.steepness.assign(block.stride, 0.0);
    StepRecord record;

    BlockHeat heat(solve, level, block, lanes);
    std::optional<BlockHeat> behind;
    if (!block.behind.empty()) {
        behind.emplace(solve, level, block, lanes, true);
        batch.behind_before = behind->at_start;
        batch.behind = behind->at_end;
        batch.wet_behind = back_of(solve, block).wet;
    }
    StageForcing now = kind.middle(block, 0);
    begin_plates(step, surface, now.air, heat.at_end, batch);
    KelvinRecord kelvin(solve, block);
    kelvin.put(batch.temperature[0].data(), batch.temperature[1].data());
    record_plates(solve, kind, batch, block, 0,
                  {now.air, heat.at_end, batch.temperature[0].data()});
    std::size_t at = 0;
    for (std::size_t i = level.stride; i <= solve.steps(); i += level.stride) {
        heat.begin_step(i);
        if (behind) behind->begin_step(i);
        for (int s = 0; s < substeps; ++s) {
            ++at;
            const StageForcing before = now;
            now = kind.middle(block, at);
            heat.begin_substep(s, at);
            if (behind) {
                behind->begin_substep(s, at);
                batch.behind_jumps = behind->jumps;
            }
            advance_plates(step, surface,
                           {.air_before = before.air,
                            .air = now.air,
                            .heat_before = heat.at_start,
                            .heat = heat.at_end,
                            .jumps = heat.jumps},
                           batch, record);
            block.slope[at] = record.slope[0];
            block.back_slope[at] = record.slope[1];
            for (std::size_t l = 0; l < count; ++l) {
                block.steepness[l] += batch.slope[0][l] + batch.slope[1][l];
            }
        }
        heat.end_step();
        if (behind) behind->end_step();
        kelvin.put(batch.temperature[0].data(), batch.temperature[1].data());
        record_plates(solve, kind, batch, block, i,
                      {now.air, heat.at_end, batch.temperature[0].data()});
    }
    block.slope[0] = block.slope[at];  // of a span that repeats
    block.back_slope[0] = block.back_slope[at];
    block.record = record;
    block.change.assign(block.start.size(), 0.0f);
    const Eigen::MatrixXd change = step.turn * state - start;
    BlockChanges(block.change.data(), n, facets, stride) = change.cast<float>();
    block.residual = change.cwiseAbs().maxCoeff();
}

}  // namespace diurna
