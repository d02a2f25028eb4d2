#pragma once

#include <Eigen/Core>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Facets of a block to first order about its last run, with the block's mean slopes, scaled for
/// each facet to its own over the span.
struct LinearisedSpan {
    Eigen::RowVectorXd steep;  // (facet) its slopes over the block's mean ones; empty: 1
    Eigen::MatrixXd state;     // [K] in: minus that run's start; out: at its end
    Eigen::MatrixXd warmer;    // (instant, facet) [K] out: surface minus that run's
    Eigen::MatrixXf behind{};  // (instant, facet) [W m⁻²] in: more heat on plates' backs; may be
                               // empty
    Eigen::MatrixXd warmer_behind{};  // (instant, facet) [K] out: of plates' backs
};

/// Each facet's slopes over the block's mean ones in its last run.
Eigen::RowVectorXd relative_slopes(const Block& block);

/// Runs a block's linearised span from day.state, with additional heat on the surface, linear in
/// time between the level's instants. Takes a fifth of a run: no surface balance to solve.
///
/// heat  (instant, facet) [W m⁻²]; empty: none
void run_linearised(const SolveState& solve, const Level& level, const Block& block,
                    const Eigen::MatrixXf& heat, LinearisedSpan& day);

}  // namespace diurna
