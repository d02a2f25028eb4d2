#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "thermal/solve/block_heat.hpp"
#include "thermal/solve/heat_record.hpp"
#include "thermal/solve/run_block.hpp"
#include "thermal/steppers/layered_step.hpp"

namespace diurna {

namespace {

/// Substeps after one with an edge that go in equal parts, so that what is left of the jump decays
/// as it should.
constexpr int unsettled_substeps = 3;
constexpr int equal_parts = 4;

/// One lane of a block that a shadow's edge passes within a substep, or has just passed.
class Outlier {
 public:
    /// behind_at(share)  [W m⁻²] on a plate's back at a share of the substep; may be none
    Outlier(const MaterialColumn& column, const LayeredBatch& batch, std::size_t lane,
            std::function<double(double)> behind_at)
        : column_(column), lane_(lane), behind_at_(std::move(behind_at)) {
        one_.resize(column.grid.size(), 1);
        for (std::size_t i = 0; i < column.grid.size(); ++i) {
            one_.state[i * lanes] = batch.state[i * lanes + lane];
        }
        one_.temperature[0] = batch.temperature[lane];
        one_.natural[0] = batch.natural[lane];
        one_.wet_behind = batch.wet_behind;
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

    void give(LayeredBatch& batch) const {
        for (std::size_t i = 0; i < column_.grid.size(); ++i) {
            batch.state[i * lanes + lane_] = one_.state[i * lanes];
        }
        batch.temperature[lane_] = one_.temperature[0];
        batch.rate[lane_] = one_.rate[0];
        batch.taken[lane_] = one_.taken[0];
    }

 private:
    template <class Heat>
    void part_of(double step, double begin, double end, const std::array<AirFilm, 2>& air,
                 const Heat& heat_at, StepRecord& record) {
        const double length = end - begin;
        column_.stage = make_stage(column_.grid, sdirk_gamma * length * step, column_.reference);
        std::array<AirFilm, 2> between;
        double heat[2], behind[2];
        for (std::size_t k = 0; k < 2; ++k) {
            const double share = begin + stage_share[k] * length;
            // The given air is that of the whole substep's stages.
            between[k] =
                air_between(air[0], air[1], (share - stage_share[0]) / (1.0 - stage_share[0]));
            heat[k] = heat_at(share);
            behind[k] = behind_at_ ? behind_at_(share) : 0.0;
            one_.behind[k] = behind_at_ ? &behind[k] : nullptr;
        }
        advance(column_, between, {&heat[0], &heat[1]}, one_, record);
    }

    MaterialColumn column_;
    std::size_t lane_;
    std::function<double(double)> behind_at_;
    LayeredBatch one_;
};

/// A block in progress over the span.
class LayeredRun {
 public:
    LayeredRun(SolveState& solve, const Level& level, Block& block)
        : solve_(solve),
          level_(level),
          block_(block),
          kind_(level.kind[block.material]),
          count_(block.facet.size()),
          substep_(level_step(solve, level) / kind_.column.substeps),
          heat_(solve, level, block, count_),
          kelvin_(solve, block) {
        if (!block.behind.empty()) {
            behind_.emplace(solve, level, block, count_, true);
            batch_.behind = {behind_at_stage_[0], behind_at_stage_[1]};
            batch_.wet_behind = back_of(solve, block).wet;
        }
        batch_.resize(kind_.column.grid.size(), count_);
        batch_.state = block.start;
        const std::vector<NaturalFilm> natural = natural_films(solve, block);
        std::copy(natural.begin(), natural.end(), batch_.natural.begin());
        for (std::size_t l = 0; l < count_; ++l) {
            batch_.temperature[l] = batch_.state[l] + kind_.column.reference;
        }
    }

    void run() {
        block_.slope.assign(kind_.times, 0.0);
        block_.record = {};
        put_temperatures();
        record_block(solve_, block_, kind_, 0,
                     {kind_.middle(block_, 0).air, heat_.at_end, batch_.temperature.data()});
        std::size_t stage = 0;
        for (std::size_t i = level_.stride; i <= solve_.steps(); i += level_.stride) {
            heat_.begin_step(i);
            if (behind_) behind_->begin_step(i);
            for (int s = 0; s < kind_.column.substeps; ++s, stage += 2) {
                begin_substep(s, stage);
                pass_edges();
                pass_unsettled();
                advance(kind_.column, air_, {at_stage_[0], at_stage_[1]}, batch_, block_.record);
                for (const Outlier& stray : outliers_) stray.give(batch_);
                std::copy_n(block_.record.slope.begin(), 2, block_.slope.begin() + stage);
            }
            heat_.end_step();
            if (behind_) behind_->end_step();
            put_temperatures();
            record_block(
                solve_, block_, kind_, i,
                {air_[1], at_stage_[1], batch_.temperature.data(), {batch_.taken.data(), count_}});
            if (behind_) {
                record_backs(solve_, block_, i, {air_[1], behind_at_stage_[1], back_kelvin_, {}});
            }
        }
        compare_with_start();
    }

 private:
    void put_temperatures() {
        const std::size_t last = kind_.column.grid.size() - 1;
        for (std::size_t l = 0; l < count_; ++l) {
            back_kelvin_[l] = batch_.state[last * lanes + l] + kind_.column.reference;
        }
        kelvin_.put(batch_.temperature.data(), back_kelvin_);
    }
    void begin_substep(int s, std::size_t stage) {
        substep_number_ = s;
        outliers_.clear();
        for (std::size_t k = 0; k < 2; ++k) {
            const StageForcing forcing = kind_.middle(block_, stage + k);
            air_[k] = forcing.air;
            sky_[k] = kind_.column.surface.emissivity * forcing.sky_longwave;
            for (std::size_t l = 0; l < count_; ++l) {
                at_stage_[k][l] = heat_.smooth(l, share_of_step(stage_share[k])) + sky_[k];
            }
            if (!behind_) continue;
            behind_sky_[k] = back_of(solve_, block_).emissivity * forcing.sky_longwave;
            for (std::size_t l = 0; l < count_; ++l) {
                behind_at_stage_[k][l] =
                    behind_->straight(l, share_of_step(stage_share[k])) + behind_sky_[k];
            }
        }
    }
    double share_of_step(double share_of_substep) const {
        return (substep_number_ + share_of_substep) / kind_.column.substeps;
    }
    /// Absorbed longwave of the sky, straight through the substep's stages.
    double sky_at(double share) const { return between_stages(sky_, share); }
    double between_stages(const double (&at)[2], double share) const {
        const double along = (share - stage_share[0]) / (1.0 - stage_share[0]);
        return at[0] + along * (at[1] - at[0]);
    }
    /// What a lane's back absorbs at a share of the substep, if it has one.
    std::function<double(double)> behind_lane(std::size_t l) const {
        if (!behind_) return {};
        return [this, l](double share) {
            return behind_->straight(l, share_of_step(share)) + between_stages(behind_sky_, share);
        };
    }

    /// Lanes that an edge passes in this substep go it by themselves; those it has passed before
    /// get what it brought.
    void pass_edges() {
        for (const Block::Jump& edge : heat_.edges()) {
            const std::size_t l = edge.lane;
            const double within = edge.share * kind_.column.substeps - substep_number_;
            if (within >= 1.0) continue;
            for (auto& heat : at_stage_) heat[l] += heat_.jump(l);
            if (within < 0.0) continue;
            unsettled_[l] = unsettled_substeps + 1;
            outliers_.emplace_back(kind_.column, batch_, l, behind_lane(l))
                .run(
                    substep_, std::clamp(within, 1e-3, 1.0 - 1e-3), air_,
                    [&](double share, bool passed) {
                        return heat_.smooth(l, share_of_step(share)) + sky_at(share) +
                               (passed ? heat_.jump(l) : 0.0);
                    },
                    block_.record);
        }
    }
    /// Lanes that an edge has passed in a substep shortly before.
    void pass_unsettled() {
        for (std::size_t l = 0; l < count_; ++l) {
            if (unsettled_[l] == 0) continue;
            if (--unsettled_[l] == unsettled_substeps) continue;  // its edge is in this one
            // An edge yet to come in this step has not jumped; one that has is in the heat.
            const double jumped = at_stage_[1][l] - sky_[1] - heat_.smooth(l, share_of_step(1.0));
            outliers_.emplace_back(kind_.column, batch_, l, behind_lane(l))
                .run_on(
                    substep_, air_,
                    [&](double share) {
                        return heat_.smooth(l, share_of_step(share)) + sky_at(share) + jumped;
                    },
                    block_.record);
        }
    }

    void compare_with_start() {
        block_.residual = 0.0;
        block_.change.resize(batch_.state.size());
        for (std::size_t i = 0; i < kind_.column.grid.size(); ++i) {
            for (std::size_t l = 0; l < count_; ++l) {
                const std::size_t at = i * lanes + l;
                const double change = batch_.state[at] - block_.start[at];
                block_.change[at] = float(change);
                block_.residual = std::max(block_.residual, std::abs(change));
            }
        }
    }

    SolveState& solve_;
    const Level& level_;
    Block& block_;
    const Kind& kind_;
    std::size_t count_;
    double substep_;  // [s]
    BlockHeat heat_;
    std::optional<BlockHeat> behind_{};
    LayeredBatch batch_;
    int unsettled_[lanes] = {};  // substeps to go in parts
    // of the substep
    int substep_number_ = 0;
    std::array<AirFilm, 2> air_{};
    double sky_[2] = {}, at_stage_[2][lanes];                // [W m⁻²]
    double behind_sky_[2] = {}, behind_at_stage_[2][lanes];  // of backs
    double back_kelvin_[lanes] = {};
    KelvinRecord kelvin_;
    std::vector<Outlier> outliers_;
};

}  // namespace

void run_layered(SolveState& solve, const Level& level, Block& block) {
    LayeredRun(solve, level, block).run();
}

}  // namespace diurna
