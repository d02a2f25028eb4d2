#include "thermal/solve/pass.hpp"

#include "materials/base/parallel.hpp"
#include "thermal/solve/run_block.hpp"

namespace diurna {

void pass(SolveState& solve, const Level& level, double progress_from, double progress_to) {
    constexpr std::size_t slices = 8;
    for (std::size_t slice = 0; slice < slices; ++slice) {
        const std::size_t from = solve.block.size() * slice / slices;
        const std::size_t to = solve.block.size() * (slice + 1) / slices;
        for_each_index(
            to - from,
            [&](std::size_t b) {
                Block& block = solve.block[from + b];
                block.rests = solve.of_target(block) ||
                              (!solve.record && block.settled(solve.options, solve.left_by_pass));
                if (block.rests) return;
                if (level.kind[block.material].modes) {
                    run_modes(solve, level, block);
                } else if (level.kind[block.material].plate) {
                    run_plates(solve, level, block);
                } else {
                    run_layered(solve, level, block);
                }
                block.heat_change = block.unfollowed = block.warmed = block.relit = 0.0;
            },
            4);
        if (solve.options.progress) {
            solve.options.progress(progress_from +
                                   (progress_to - progress_from) * double(slice + 1) / slices);
        }
    }
}

}  // namespace diurna
