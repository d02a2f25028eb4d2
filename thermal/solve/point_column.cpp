#include "thermal/solve/point_column.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

/// The slowest deviations of a thawed column under a usual film: C⁻¹ K's, orthonormal in C.
void find_slow(double duration, PointColumn& point) {
    constexpr double film = 10.0;    // [W m⁻² K⁻¹]
    constexpr double decayed = 2.5;  // a deviation that falls by e^−2.5 in the span needs no Newton
    constexpr Eigen::Index most = 12;
    const EnthalpyColumn& c = point.plain;
    const auto n = static_cast<Eigen::Index>(c.node.size());
    if (std::any_of(c.node.begin(), c.node.end(),
                    [](const EnthalpyNode& node) { return node.latent > 0.0 && !node.drains; })) {
        // Water that is half frozen keeps what it is given: nothing is sure to be quick.
        point.slow = point.weight = Eigen::MatrixXd::Identity(n, n);
        return;
    }
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd root(n);
    for (Eigen::Index i = 0; i < n; ++i) root[i] = std::sqrt(c.node[std::size_t(i)].thawed);
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
        const EnthalpyLink& link = c.link[std::size_t(i)];
        const double g = link.per_width * link.thawed;
        k(i, i) += g;
        k(i + 1, i + 1) += g;
        k(i, i + 1) -= g;
        k(i + 1, i) -= g;
    }
    k(0, 0) += film;
    k(n - 1, n - 1) +=
        c.below_is_link ? c.below_link.per_width * c.below_link.thawed : c.below_conductance;
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) k(i, j) /= root[i] * root[j];
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(k);
    Eigen::Index count = 1;
    while (count < std::min(n, most) && modes.eigenvalues()[count] * duration < decayed) ++count;
    point.slow = modes.eigenvectors().leftCols(count).array().colwise() / root.array();
    point.weight = modes.eigenvectors().leftCols(count).array().colwise() * root.array();
}

}  // namespace

PointColumn point_column(const SolveState& solve, const MaterialColumn& material) {
    const ThermalSurface& surface = material.surface;
    // Behind a plate stands air; the grid then ends free.
    const Bottom bottom = surface.back ? Bottom{FixedFlux{0.0}} : surface.bottom;
    PointColumn point{.column = NonlinearColumn(surface.layers, bottom, material.reference,
                                                grid_of_point(surface, solve.options.grid)),
                      .plain = {},
                      .slow = {},
                      .weight = {}};
    point.plain = point.column.enthalpy();
    if (solve.options.periodic) find_slow(solve.options.duration, point);
    return point;
}

bool in_lanes(const ThermalSurface& surface) {
    const auto* room = std::get_if<Interior>(&surface.bottom);
    const bool schedules = !surface.internal_schedule.empty() || (room && !room->schedule.empty());
    return !schedules && std::holds_alternative<std::monostate>(surface.canopy) &&
           std::none_of(surface.layers.begin(), surface.layers.end(), [](const Layer& layer) {
               return std::holds_alternative<Radiating>(layer.law);
           });
}

}  // namespace diurna
