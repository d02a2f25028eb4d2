#include <algorithm>
#include <cmath>

#include "thermal/passes.hpp"

namespace diurna {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Strided = Eigen::Map<Rows, 0, Eigen::OuterStride<>>;

}  // namespace

void set_plate_films(Kind& kind, double front, double back, double step) {
    kind.plate = make_plate_step(kind.column.grid, kind.column.reference, std::max(1.0, front),
                                 std::max(1.0, back), step / kind.column.substeps);
}

void run_plates(Job& job, const Level& level, Block& block) {
    const Kind& kind = level.kind[block.material];
    const PlateStep& step = *kind.plate;
    const ThermalSurface& surface = kind.column.surface;
    const int substeps = kind.column.substeps;
    const std::size_t count = block.facet.size();
    const Eigen::OuterStride<> stride{Eigen::Index(lanes)};
    const auto n = Eigen::Index(step.modes()), facets = Eigen::Index(count);
    PlateBatch batch;
    batch.resize(step.modes(), count);
    std::copy(block.natural.begin(), block.natural.end(), batch.natural.begin());
    const Strided start(block.start.data(), n, facets, stride);
    Strided state(batch.state.data(), n, facets, stride);
    state.noalias() = step.into * start;
    block.slope.assign(kind.forcing.size(), 0.0);
    block.back_slope.assign(kind.forcing.size(), 0.0);
    block.steepness.assign(block.stride, 0.0);
    StepRecord record;

    // Heat of sun, terrain and what is inside at the step's ends; with the sky's at the substep's.
    alignas(64) double before[lanes], after[lanes], heat_before[lanes], heat[lanes],
        jump[lanes] = {};
    facet_heat(job, block, kind, 0, before);
    for (std::size_t l = 0; l < lanes; ++l) {
        heat[l] = before[l] + surface.emissivity * kind.forcing[0].sky_longwave;
    }
    begin_plates(step, surface, kind.forcing[0].air, heat, batch);
    const auto keep = [&](std::size_t i) {
        float* const row = job.kelvin.data() + i * job.facets;
        for (std::size_t l = 0; l < count; ++l)
            row[block.facet[l]] = float(batch.temperature[0][l]);
    };
    keep(0);
    std::vector<HeatJump> jumps;
    std::size_t at = 0;
    for (std::size_t i = level.stride; i <= job.steps(); i += level.stride) {
        facet_heat(job, block, kind, i, after);
        const std::span<const HeatJump> edges = edges_of(level, block, i);
        const double absorptance = edges.empty() ? 0.0 : absorptance_at(job, kind, i);
        for (const HeatJump& edge : edges) jump[edge.lane] = absorptance * edge.heat;
        for (int s = 0; s < substeps; ++s) {
            ++at;
            const double sky = surface.emissivity * kind.forcing[at].sky_longwave;
            const double share = double(s + 1) / substeps;
            for (std::size_t l = 0; l < lanes; ++l) {
                heat_before[l] = heat[l];
                heat[l] = before[l] + share * (after[l] - before[l] - jump[l]) + sky;
            }
            jumps.clear();
            for (const HeatJump& edge : edges) {
                const double within = edge.share * substeps - s;
                if (within < 1.0) heat[edge.lane] += jump[edge.lane];
                if (within >= 0.0 && within < 1.0) {
                    jumps.push_back(
                        {edge.lane, std::clamp(within, 1e-3, 1.0 - 1e-3), jump[edge.lane]});
                }
            }
            advance_plates(step, surface,
                           {.air_before = kind.forcing[at - 1].air,
                            .air = kind.forcing[at].air,
                            .heat_before = heat_before,
                            .heat = heat,
                            .jumps = jumps},
                           batch, record);
            block.slope[at] = record.slope[0];
            block.back_slope[at] = record.slope[1];
            for (std::size_t l = 0; l < count; ++l) {
                block.steepness[l] += batch.slope[0][l] + batch.slope[1][l];
            }
        }
        for (const HeatJump& edge : edges) jump[edge.lane] = 0.0;
        keep(i);
        std::copy_n(after, lanes, before);
    }
    block.slope[0] = block.slope[at];  // of a span that repeats
    block.back_slope[0] = block.back_slope[at];
    block.record = record;
    block.change.assign(block.start.size(), 0.0);
    Strided change(block.change.data(), n, facets, stride);
    change.noalias() = step.turn * state;
    change -= start;
    block.residual = change.cwiseAbs().maxCoeff();
    block.heat_change = 0.0;
}

}  // namespace diurna
