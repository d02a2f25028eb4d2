#pragma once

#include <cstddef>
#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Accelerates slow or alternating sequences of passes. Ground under a body receives back most of
/// its emission; its slopes differ from its block's, and the correction of exchange_longwave() is
/// then wrong by the same share, λ, pass after pass: too large (−0.8 under a crate on grass, −2 on
/// water) or too small. Three passes in a row show λ, by block, from neighbours' longwave; all
/// further passes would add λ / (1 − λ) of the last change (Aitken's Δ² for vectors: A. Sidi,
/// Vector Extrapolation Methods, SIAM 2017). Converged blocks are not changed.
class Extrapolation {
 public:
    /// Call after each pass that has not converged. Has no cost in scenes that converge in a few
    /// passes.
    void after_pass(SolveState& solve);

 private:
    struct Iterate {
        std::vector<float> excess;  // (facet, instant) of front faces, then of backs
        std::vector<double> start;
    };
    static Iterate taken(const SolveState& solve, const Block& block);

    std::size_t passes_ = 0;
    std::vector<std::vector<Iterate>> of_block_;  // (block) up to three
};

}  // namespace diurna
