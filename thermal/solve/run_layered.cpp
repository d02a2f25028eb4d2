#include "thermal/solve/run_block.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

/// Substeps after one with an edge that go in equal parts, so that what is left of the jump decays
/// as it should.
constexpr int unsettled_substeps = 3;
constexpr int equal_parts = 4;

/// One lane of a block that a shadow's edge passes within a substep, or has just passed.
class Stray {
 public:
    Stray(const MaterialColumn& column, const Batch& batch, std::size_t lane)
        : column_(column), lane_(lane) {
        one_.resize(column.grid.size(), 1);
        for (std::size_t i = 0; i < column.grid.size(); ++i) {
            one_.state[i * lanes] = batch.state[i * lanes + lane];
        }
        one_.temperature[0] = batch.temperature[lane];
        one_.natural[0] = batch.natural[lane];
    }

    /// To the edge, and from there on in parts of growing length.
    ///
    /// heat_at(share, after)  [W m⁻²] at a share of the substep, before or after the edge
    template <class Heat>
    void run(double step, double edge, const std::array<AirFilm, 2>& air, const Heat& heat_at,
             StepRecord& record) {
        double begin = 0.0;
        for (int part = 0; part <= parts_after_jump; ++part) {
            const double end = edge + (1.0 - edge) * part_after_jump[part];
            const bool after = part > 0;
            part_of(
                step, begin, end, air, [&](double share) { return heat_at(share, after); }, record);
            begin = end;
        }
    }
    template <class Heat>
    void run_on(double step, const std::array<AirFilm, 2>& air, const Heat& heat_at,
                StepRecord& record) {
        for (int part = 0; part < equal_parts; ++part) {
            part_of(step, double(part) / equal_parts, (part + 1.0) / equal_parts, air, heat_at,
                    record);
        }
    }

    void give(Batch& batch) const {
        for (std::size_t i = 0; i < column_.grid.size(); ++i) {
            batch.state[i * lanes + lane_] = one_.state[i * lanes];
        }
        batch.temperature[lane_] = one_.temperature[0];
        batch.rate[lane_] = one_.rate[0];
    }

 private:
    template <class Heat>
    void part_of(double step, double begin, double end, const std::array<AirFilm, 2>& air,
                 const Heat& heat_at, StepRecord& record) {
        const double length = end - begin;
        column_.stage = make_stage(column_.grid, sdirk_gamma * length * step, column_.reference);
        std::array<AirFilm, 2> between;
        double heat[2];
        for (std::size_t k = 0; k < 2; ++k) {
            const double share = begin + stage_share[k] * length;
            // The given air is that of the whole substep's stages.
            between[k] =
                air_between(air[0], air[1], (share - stage_share[0]) / (1.0 - stage_share[0]));
            heat[k] = heat_at(share);
        }
        advance(column_, between, {&heat[0], &heat[1]}, one_, record);
    }

    MaterialColumn column_;
    std::size_t lane_;
    Batch one_;
};

}  // namespace

void run_layered(SolveState& solve, const Level& level, Block& block) {
    const Kind& kind = level.kind[block.material];
    const int substeps = kind.column.substeps;
    const double substep = level_step(solve, level) / substeps;
    const std::size_t count = block.facet.size();
    const double emissivity = kind.column.surface.emissivity;
    Batch batch;
    batch.resize(kind.column.grid.size(), count);
    batch.state = block.start;
    std::copy(block.natural.begin(), block.natural.end(), batch.natural.begin());
    block.slope.assign(kind.forcing.size(), 0.0);
    StepRecord record;

    double before[lanes], after[lanes], heat[2][lanes], jump[lanes] = {};
    int unsettled[lanes] = {};  // substeps to go in parts
    facet_heat(solve, block, kind, 0, before);
    for (std::size_t l = 0; l < count; ++l) {
        batch.temperature[l] = batch.state[l] + kind.column.reference;
        solve.kelvin[block.facet[l]] = float(batch.temperature[l]);
    }
    std::vector<Stray> strays;
    std::size_t stage = 0;
    for (std::size_t i = level.stride; i <= solve.steps(); i += level.stride) {
        facet_heat(solve, block, kind, i, after);
        const std::span<const HeatJump> edges = edges_of(level, block, i);
        const double absorptance = edges.empty() ? 0.0 : absorptance_at(solve, kind, i);
        for (const HeatJump& edge : edges) jump[edge.lane] = absorptance * edge.heat;
        for (int s = 0; s < substeps; ++s, stage += 2) {
            const std::array<AirFilm, 2> air{kind.forcing[stage].air, kind.forcing[stage + 1].air};
            const double sky[2]{emissivity * kind.forcing[stage].sky_longwave,
                                emissivity * kind.forcing[stage + 1].sky_longwave};
            const auto smooth = [&](std::size_t l, double share_of_step) {
                return before[l] + share_of_step * (after[l] - before[l] - jump[l]);
            };
            for (int k = 0; k < 2; ++k) {
                const double share = (s + stage_share[k]) / substeps;
                for (std::size_t l = 0; l < count; ++l) heat[k][l] = smooth(l, share) + sky[k];
            }
            strays.clear();
            const auto sky_at = [&](double share) {
                const double along = (share - stage_share[0]) / (1.0 - stage_share[0]);
                return sky[0] + along * (sky[1] - sky[0]);
            };
            for (const HeatJump& edge : edges) {
                const std::size_t l = edge.lane;
                const double within = edge.share * substeps - s;
                if (within >= 1.0) continue;
                for (int k = 0; k < 2; ++k) heat[k][l] += jump[l];
                if (within < 0.0) continue;
                unsettled[l] = unsettled_substeps + 1;
                strays.emplace_back(kind.column, batch, l)
                    .run(
                        substep, std::clamp(within, 1e-3, 1.0 - 1e-3), air,
                        [&](double share, bool passed) {
                            return smooth(l, (s + share) / substeps) + sky_at(share) +
                                   (passed ? jump[l] : 0.0);
                        },
                        record);
            }
            for (std::size_t l = 0; l < count; ++l) {
                if (unsettled[l] == 0) continue;
                if (--unsettled[l] == unsettled_substeps) continue;  // its edge is in this one
                // An edge yet to come in this step has not jumped; one that has is in the heat.
                const double jumped = heat[1][l] - sky[1] - smooth(l, (s + 1.0) / substeps);
                strays.emplace_back(kind.column, batch, l)
                    .run_on(
                        substep, air,
                        [&](double share) {
                            return smooth(l, (s + share) / substeps) + sky_at(share) + jumped;
                        },
                        record);
            }
            advance(kind.column, air, {heat[0], heat[1]}, batch, record);
            for (const Stray& stray : strays) stray.give(batch);
            block.slope[stage] = record.slope[0];
            block.slope[stage + 1] = record.slope[1];
        }
        float* row = solve.kelvin.data() + i * solve.facets;
        for (std::size_t l = 0; l < count; ++l) row[block.facet[l]] = float(batch.temperature[l]);
        for (const HeatJump& edge : edges) jump[edge.lane] = 0.0;
        std::swap(before, after);
    }
    block.record = record;
    block.residual = block.heat_change = 0.0;
    block.change.resize(batch.state.size());
    for (std::size_t i = 0; i < kind.column.grid.size(); ++i) {
        for (std::size_t l = 0; l < count; ++l) {
            const std::size_t at = i * lanes + l;
            block.change[at] = batch.state[at] - block.start[at];
            block.residual = std::max(block.residual, std::abs(block.change[at]));
        }
    }
}

}  // namespace diurna
