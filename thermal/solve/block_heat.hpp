#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Heat input of the lanes of a block from sun, terrain, interior and sky, by step and substep [W
/// m⁻²]: linear over each step except for jumps of sunlight.
class BlockHeat {
 public:
    /// At the first instant. filled: lanes of the block that are computed, at most mode_lanes;
    /// backs: their backs.
    BlockHeat(const SolveState& solve, const Level& level, const Block& block, std::size_t filled,
              bool backs = false);

    /// Begins the step that ends at instant i.
    void begin_step(std::size_t i);
    /// Begins its substep s, which ends at a time of the material's forcing; `at_start` takes the
    /// values of `at_end`.
    void begin_substep(int s, std::size_t time);
    void end_step();

    /// The jumps of sunlight in the step, and their size in a lane's heat.
    std::span<const Block::Jump> edges() const { return edges_; }
    double jump(std::size_t lane) const { return jump_[lane]; }
    /// The same without the sky, with its jumps spread over the step.
    double straight(std::size_t lane, double share) const {
        return before_[lane] + share * (after_[lane] - before_[lane]);
    }
    /// A lane's heat at a share of the step, without its jumps and the sky.
    double smooth(std::size_t lane, double share) const {
        return before_[lane] + share * (after_[lane] - before_[lane] - jump_[lane]);
    }

    alignas(64) double at_start[mode_lanes] = {}, at_end[mode_lanes] = {};  // of the substep
    std::vector<HeatJump> jumps;                                            // within the substep

 private:
    void add_sky(std::size_t time);
    BlockFace face(std::size_t i) const {
        return backs_ ? back_of(solve_, block_) : front_of(solve_, block_, kind_, i);
    }

    const SolveState& solve_;
    const Level& level_;
    const Block& block_;
    const Kind& kind_;
    std::size_t filled_;
    bool backs_;
    FaceHeat face_heat_;
    std::span<const Block::Jump> edges_;
    alignas(64) double before_[mode_lanes], after_[mode_lanes], jump_[mode_lanes] = {};
};

}  // namespace diurna
