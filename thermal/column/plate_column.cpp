#include "thermal/column/plate_column.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace diurna {

PlateStep make_plate_step(const ColumnGrid& grid, double reference, double front_film,
                          double back_film, double step) {
    const auto n = Eigen::Index(grid.size());
    Eigen::MatrixXd conduct = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
        const double link = grid.conductance[std::size_t(i)];
        conduct.block<2, 2>(i, i) += link * Eigen::Matrix2d{{1.0, -1.0}, {-1.0, 1.0}};
    }
    conduct(0, 0) += front_film;
    conduct(n - 1, n - 1) += back_film;
    const Eigen::VectorXd root = Eigen::VectorXd::Map(grid.capacity.data(), n).cwiseSqrt();
    const Eigen::VectorXd inverse = root.cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(inverse.asDiagonal() * conduct *
                                                                inverse.asDiagonal());
    PlateStep result{.step = step,
                     .reference = reference,
                     .film = {front_film, back_film},
                     .rate = {},
                     .face = {},
                     .decay = {},
                     .from = {},
                     .to = {},
                     .response = {},
                     .turn = inverse.asDiagonal() * solver.eigenvectors(),
                     .into = solver.eigenvectors().transpose() * root.asDiagonal()};
    for (Eigen::Index m = 0; m < n; ++m) {
        const double rate = std::max(0.0, solver.eigenvalues()[m]);
        const double f0 = result.turn(0, m), f1 = result.turn(n - 1, m);
        const StepWeights p = step_weights(rate * step);
        const double to = step * p.second;
        result.rate.push_back(rate);
        result.face[0].push_back(f0);
        result.face[1].push_back(f1);
        result.decay.push_back(p.decay);
        result.from.push_back(step * (p.first - p.second));
        result.to.push_back(to);
        result.response[0] += to * f0 * f0;
        result.response[1] += to * f0 * f1;
        result.response[2] += to * f1 * f1;
    }
    return result;
}

}  // namespace diurna
