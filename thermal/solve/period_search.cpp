#include "thermal/solve/period_search.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

/// A node that lies at the melting point all day freezes or melts by the same each day: how many
/// days until the fastest is through.
double days_to_melt(const NonlinearColumn& column, const Eigen::VectorXd& start,
                    const Eigen::VectorXd& drift) {
    double fastest = 1e-5, days = 0.0;  // of a node's water a day
    for (Eigen::Index i = 0; i < start.size(); ++i) {
        const double by = drift[i], from = start[i];
        if (!column.melts(std::size_t(i)) || from < 0.0 || from > 1.0) continue;
        if (std::abs(by) < fastest) continue;
        fastest = std::abs(by);
        days = (by > 0.0 ? 1.0 - from : from) / fastest + 0.01;
    }
    return days;
}

}  // namespace

Eigen::VectorXd next_start(const PointColumn& point, const Eigen::VectorXd& start,
                           const Eigen::VectorXd& end, const Eigen::MatrixXd& map,
                           PeriodSearch& search) {
    constexpr double farthest = 20.0;
    const NonlinearColumn& column = point.column;
    const Eigen::VectorXd change = end - start;
    const double before = search.residual;
    search.residual = search.move = change.cwiseAbs().maxCoeff();
    // Where a front of freezing passes other nodes than it did, the map before misleads.
    search.plain = !search.plain && search.residual > 0.5 * before && !column.linear();
    if (search.plain) return end;
    const Eigen::Index m = point.slow.cols();
    const Eigen::VectorXd slow = point.weight.transpose() * change;
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(m, m) - point.weight.transpose() * map;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> period;
    period.setThreshold(1e-5);  // a column that loses nothing keeps its mean; the map is of floats
    period.compute(left);
    const Eigen::VectorXd move = change + point.slow * (period.solve(slow) - slow);
    // What no start explains goes on for days.
    const Eigen::VectorXd drift = change - move + map * (point.weight.transpose() * move);
    const double through = days_to_melt(column, start, drift);
    const double most = column.linear() ? 1e4 : farthest;
    Eigen::VectorXd next(start.size());
    for (Eigen::Index i = 0; i < start.size(); ++i) {
        const std::size_t node = std::size_t(i);
        double to = start[i] + std::clamp(move[i] + through * drift[i], -most, most);
        to = column.up_to_kink(node, start[i], to);
        const double t = column.temperature(node, to);
        if (t < 1.0 || t > 5000.0) to = column.state_of(node, std::clamp(t, 1.0, 5000.0));
        next[i] = to;
    }
    search.move = move.cwiseAbs().maxCoeff();
    return next;
}

}  // namespace diurna
