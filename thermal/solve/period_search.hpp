#pragma once

#include "thermal/solve/point_column.hpp"

namespace diurna {

/// Search for a facet's periodic state.
///
/// Newton only on the slowest deviations of the column; faster ones converge by repeated spans
/// (Lust, Roose, Spence & Champneys 1998, SIAM J. Sci. Comput. 19, 1188).
struct PeriodSearch {
    double residual = 1e9;  // [K, or of a node's water] largest change over the last span
    double move = 1e9;      // the same for the start
    bool plain = false;     // the last start was the previous end
};

/// The next start, (node), after a span from `start` to `end`.
///
/// map  (node, k) result of the deviations PointColumn::slow of the start
Eigen::VectorXd next_start(const PointColumn& column, const Eigen::VectorXd& start,
                           const Eigen::VectorXd& end, const Eigen::MatrixXd& map,
                           PeriodSearch& search);

}  // namespace diurna
