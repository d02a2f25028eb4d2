#include "thermal/solve/handed_state.hpp"

#include <array>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

/// Whether the start is only a first guess: of a periodic span, whose start is sought.
bool guesses_start(const SolveState& solve) { return solve.options.periodic; }

/// Sets out a block's columns from those of another solve's blocks, facet by facet.
void set_out_lanes(const SolveState& solve, const HeatState& from,
                   const std::vector<std::array<std::size_t, 2>>& place, Block& block) {
    const std::size_t states = block.start.size() / block.stride;
    for (std::size_t lane = 0; lane < block.facet.size(); ++lane) {
        const auto [b, l] = place[block.facet[lane]];
        const std::size_t stride = b < from.block.size() ? from.block[b].size() / states : 0;
        if (stride * states == 0 || from.block[b].size() != stride * states || l >= stride) {
            if (guesses_start(solve)) continue;  // as settled
            throw InputError("thermal solve", "the initial state belongs to other columns");
        }
        for (std::size_t m = 0; m < states; ++m) {
            block.start[m * block.stride + lane] = from.block[b][m * stride + l];
        }
    }
}

}  // namespace

bool set_out_from(const HeatState& from, PackedField guess, SolveState& solve) {
    const bool same_blocks = from.of_block.empty();
    if (from.kelvin.size() != solve.facets ||
        (same_blocks && from.block.size() != solve.block.size())) {
        throw InputError("thermal solve", "the initial state belongs to other facets");
    }
    if (same_blocks) {
        for (std::size_t b = 0; b < solve.block.size(); ++b) {
            if (from.block[b].size() != solve.block[b].start.size()) {
                throw InputError("thermal solve", "the initial state belongs to other columns");
            }
            solve.block[b].start = from.block[b];
        }
    } else {
        std::vector<std::array<std::size_t, 2>> place(solve.facets, {from.block.size(), 0});
        for (std::size_t b = 0; b < from.of_block.size(); ++b) {
            for (std::size_t l = 0; l < from.of_block[b].size(); ++l) {
                place[from.of_block[b][l]] = {b, l};
            }
        }
        for (Block& block : solve.block) set_out_lanes(solve, from, place, block);
    }
    if (guess.slots() == solve.kelvin.slots() && guess.facets() == solve.facets) {
        solve.kelvin = std::move(guess);
        return true;
    }
    for (std::size_t f = 0; f < solve.facets; ++f) solve.kelvin.fill(f, from.kelvin[f]);
    return false;
}

HeatState left_by(SolveState& solve, const Level& level, const PointFacets& points,
                  const NetworkFacets& targets) {
    HeatState end{.reference = level.kind.front().column.reference,
                  .kelvin = {},
                  .block = {},
                  .point = points.left(),
                  .network = targets.left()};
    end.kelvin.resize(solve.facets);
    solve.kelvin.decode(solve.steps(), end.kelvin);
    for (const Block& block : solve.block) {
        std::vector<double>& state = end.block.emplace_back(block.start);
        end.of_block.push_back(block.facet);
        if (solve.options.periodic || solve.of_target(block)) continue;
        for (std::size_t i = 0; i < state.size(); ++i) state[i] += double(block.change[i]);
    }
    return end;
}

}  // namespace diurna
