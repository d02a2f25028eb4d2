#pragma once

#include "thermal/solve/point_column.hpp"

namespace diurna {

/// A facet's search for the state that a span leads back to.
///
/// By Newton on the slowest deviations of the column alone, what is quicker follows by itself
/// (Lust, Roose, Spence & Champneys 1998, SIAM J. Sci. Comput. 19, 1188).
struct PeriodSearch {
    double residual = 1e9;  // [K, or of a node's water] largest change over the last span
    double move = 1e9;      // the same of the start
    bool plain = false;     // the last start was the end before
};

/// The next start, (node), after a span from `start` to `end`.
///
/// map  (node, k) what became of the deviations PointColumn::slow of the start
Eigen::VectorXd next_start(const PointColumn& column, const Eigen::VectorXd& start,
                           const Eigen::VectorXd& end, const Eigen::MatrixXd& map,
                           PeriodSearch& search);

}  // namespace diurna
