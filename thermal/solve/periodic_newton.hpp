#pragma once

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Mean surface slopes of each material over the last pass, and each block's period from its own.
void renew_matrices(const SolveState& solve, Level& level, std::vector<Block>& blocks);

/// Corrects the start of every block that ran by Newton's on the period map, and the temperatures
/// of that run by what this does to first order.
void correct(SolveState& solve, const Level& level);

/// (I − M)⁻¹ change of every facet of a block, (state, facet), whose slopes over the block's mean
/// ones are `steep`.
Eigen::MatrixXd close_period(const Block& block, const Eigen::RowVectorXd& steep,
                             const Eigen::MatrixXd& change);
/// [K] that moves of its facets' starts do to their surfaces, (instant, facet).
Eigen::MatrixXd follow_start(const Block& block, const Eigen::RowVectorXd& steep,
                             const Eigen::MatrixXd& move);

}  // namespace diurna
