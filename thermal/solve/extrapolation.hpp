#pragma once

#include <cstddef>
#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Shortens slow or alternating sequences of passes. Ground under a body gets back most of what it
/// sends; its slopes differ from its block's, and what exchange_longwave() moves it by then misses
/// by the same share, λ, pass after pass: too far (−0.8 under a crate on grass, −2 on water) or not
/// far enough. Three passes in a row show λ, by block, from neighbours' longwave; all further
/// passes would add λ / (1 − λ) of the last change (Aitken's Δ² for vectors: A. Sidi, Vector
/// Extrapolation Methods, SIAM 2017). Blocks that have settled are not touched.
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
