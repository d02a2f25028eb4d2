#pragma once

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Mean surface slopes per material over the last pass, and each block's own period
/// map.
void renew_matrices(const SolveState& solve, Level& level, std::vector<Block>& blocks);

/// Corrects the start of every block that ran by Newton on the period map, and the temperatures of
/// that run by the effect of this correction to first order.
void correct(SolveState& solve, const Level& level);

/// (I − M)⁻¹ change of every facet of a block, (state, facet); `steep` are its slopes over the
/// block's mean ones.
Eigen::MatrixXd close_period(const Block& block, const Eigen::RowVectorXd& steep,
                             const Eigen::MatrixXd& change);
/// [K] effect of changes of its facets' starts on their surfaces, (instant, facet).
Eigen::MatrixXd follow_start(const Block& block, const Eigen::RowVectorXd& steep,
                             const Eigen::MatrixXd& move);

}  // namespace diurna
