#pragma once

#include <cstddef>
#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Shortens a slow approach of passes: ground under a sheet that hides the sky gets back most of
/// what it sends, and each pass then leaves 0.8 to 0.95 of the error of the one before. Three
/// passes in a row tell that share, λ, by block, from starts and neighbours' longwave; what all
/// further ones would add is λ / (1 − λ) of the last difference (Aitken's Δ², for vectors: Sidi,
/// Vector Extrapolation Methods, SIAM 2017). Blocks that rest are not touched.
class Extrapolation {
 public:
    /// Call after each pass that has not converged. Scenes that converge in a few passes pay
    /// nothing.
    void after_pass(SolveState& solve);

 private:
    struct Iterate {
        std::vector<float> excess;  // (facet, instant) of front faces, then of those behind
        std::vector<double> start;
    };
    static Iterate taken(const SolveState& solve, const Block& block);

    std::size_t passes_ = 0;
    std::vector<std::vector<Iterate>> of_block_;  // (block) up to three
};

}  // namespace diurna
