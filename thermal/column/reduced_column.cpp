#include "thermal/column/reduced_column.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace diurna {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// K of C dθ/dt = −K θ + e₀ q (+ what comes from below).
MatrixXd conduction(const ColumnGrid& grid) {
    const auto n = static_cast<Index>(grid.size());
    MatrixXd k = MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) {
        const double g = grid.conductance[std::size_t(i)];
        k(i, i) += g;
        if (i + 1 == n) break;
        k(i + 1, i + 1) += g;
        k(i, i + 1) -= g;
        k(i + 1, i) -= g;
    }
    return k;
}

/// (K + s C)⁻¹ e₀, eliminated upward.
Eigen::VectorXcd response(const ColumnGrid& grid, std::complex<double> s) {
    const std::size_t n = grid.size();
    std::vector<std::complex<double>> follow(n, 0.0);
    std::complex<double> behind = grid.conductance[n - 1];  // admittance seen downward from node i
    for (std::size_t i = n - 1; i >= 1; --i) {
        const std::complex<double> load = s * grid.capacity[i] + behind;
        const double up = grid.conductance[i - 1];
        follow[i] = up / (up + load);
        behind = up * load / (up + load);
    }
    Eigen::VectorXcd v(static_cast<Index>(n));
    v[0] = 1.0 / (s * grid.capacity[0] + behind);
    for (std::size_t i = 1; i < n; ++i) v[Index(i)] = follow[i] * v[Index(i) - 1];
    return v;
}

/// Adds to the basis what is new in v, in the capacities' scalar product.
void extend(MatrixXd& basis, const VectorXd& capacity, VectorXd v) {
    v /= std::sqrt(v.dot(capacity.cwiseProduct(v)));
    for (int twice = 0; twice < 2; ++twice) {
        for (Index j = 0; j < basis.cols(); ++j) {
            v -= basis.col(j).dot(capacity.cwiseProduct(v)) * basis.col(j);
        }
    }
    const double left = std::sqrt(v.dot(capacity.cwiseProduct(v)));
    if (left < 1e-6) return;
    basis.conservativeResize(capacity.size(), basis.cols() + 1);
    basis.rightCols<1>() = v / left;
}

/// Galerkin's projection on a basis, in the eigenvectors of what comes out.
ReducedColumn project(const ColumnGrid& grid, double reference, const MatrixXd& k,
                      const MatrixXd& basis) {
    const auto n = static_cast<Index>(grid.size());
    const VectorXd capacity = VectorXd::Map(grid.capacity.data(), n);
    const bool open = grid.conductance.back() > 0.0;
    const MatrixXd reduced = basis.transpose() * k * basis;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(0.5 * (reduced + reduced.transpose()));
    // (T19) of docs/theory.md
    ReducedColumn column{.rate = eigen.eigenvalues().cwiseMax(0.0),
                         .surface = {},
                         .heat = {},
                         .profile = basis * eigen.eigenvectors(),
                         .depth = grid.depth,
                         .below = grid.conductance.back(),
                         .reference = open ? grid.below_temperature : reference,
                         .flux_below = open ? 0.0 : grid.below_flux,
                         .excess = VectorXd::Zero(n)};
    if (!open) column.rate[0] = 0.0;
    column.surface = column.profile.row(0).transpose();
    column.heat = column.profile.transpose() * capacity;
    for (Index i = 1; i < n; ++i) {
        column.excess[i] =
            column.excess[i - 1] + column.flux_below / grid.conductance[std::size_t(i - 1)];
    }
    return column;
}

/// From a minute to `longest`, 20 a decade and the last itself.
std::vector<double> periods(double longest) {
    std::vector<double> result{longest};
    for (int i = 0;; ++i) {
        const double period = 60.0 * std::pow(10.0, i / 20.0);
        if (period >= longest) return result;
        result.push_back(period);
    }
}

template <class Error>
double worst_of(double longest, const Error& error) {
    double worst = 0.0;
    for (const double period : periods(longest)) worst = std::max(worst, error(period));
    return worst;
}

double error_at(const ReducedColumn& column, std::span<const Layer> layers, const Bottom& bottom,
                double period, const GridOptions& grid) {
    const double frequency = 2.0 * std::numbers::pi / period;
    const auto exact = impedance(layers, bottom, frequency, grid);
    const auto scale =
        period < 3600.0 ? impedance(layers, bottom, 2.0 * std::numbers::pi / 3600.0, grid) : exact;
    return std::abs(impedance(column, frequency) - exact) / std::abs(scale);
}

double kelvin_at(const ReducedColumn& column, std::span<const Layer> layers, const Bottom& bottom,
                 double period, const GridOptions& grid) {
    constexpr double swing = 500.0, film = 8.0;
    const double frequency = 2.0 * std::numbers::pi / period;
    const auto answer = [=](std::complex<double> z) { return z / (1.0 + film * z); };
    return swing * std::abs(answer(impedance(column, frequency)) -
                            answer(impedance(layers, bottom, frequency, grid)));
}

}  // namespace

std::complex<double> impedance(const ReducedColumn& column, double frequency) {
    std::complex<double> sum = 0.0;
    for (Index m = 0; m < column.modes(); ++m) {
        sum +=
            column.surface[m] * column.surface[m] / std::complex<double>(column.rate[m], frequency);
    }
    return sum;
}

std::complex<double> impedance(std::span<const Layer> layers, const Bottom& bottom,
                               double frequency, const GridOptions& grid) {
    // Admittance looking down, carried upward: Y = A (Y' + A t) / (A + Y' t), A = √(iω k ρc),
    // t = tanh(d √(iω ρc / k)).
    std::vector<double> kept;
    double xi = 0.0;
    for (const Layer& layer : layers) {
        const double skin = std::sqrt(layer.conductivity * grid.period /
                                      (std::numbers::pi * layer.density * layer.heat_capacity));
        const bool cut = std::holds_alternative<FixedFlux>(bottom);
        kept.push_back(cut ? std::min(layer.thickness, std::max(0.0, grid.deepest - xi) * skin)
                           : layer.thickness);
        xi += layer.thickness / skin;
    }
    std::complex<double> y = 0.0;
    bool rigid = std::holds_alternative<FixedTemperature>(bottom);  // infinite admittance
    if (const auto* room = std::get_if<Interior>(&bottom)) y = room->film;
    for (std::size_t i = layers.size(); i-- > 0;) {
        if (kept[i] <= 0.0) continue;
        const double heat = layers[i].density * layers[i].heat_capacity;
        const std::complex<double> iw(0.0, frequency);
        const std::complex<double> a = std::sqrt(iw * layers[i].conductivity * heat);
        const std::complex<double> t =
            std::tanh(kept[i] * std::sqrt(iw * heat / layers[i].conductivity));
        y = rigid ? a / t : a * (y + a * t) / (a + y * t);
        rigid = false;
    }
    return 1.0 / y;
}

double reduction_error(const ReducedColumn& column, std::span<const Layer> layers,
                       const Bottom& bottom, double longest, const GridOptions& grid) {
    return worst_of(longest,
                    [&](double period) { return error_at(column, layers, bottom, period, grid); });
}

double surface_error(const ReducedColumn& column, std::span<const Layer> layers,
                     const Bottom& bottom, double longest, const GridOptions& grid) {
    return worst_of(longest,
                    [&](double period) { return kelvin_at(column, layers, bottom, period, grid); });
}

ReducedColumn reduce_column(std::span<const Layer> layers, const Bottom& bottom, double reference,
                            const ReductionOptions& options) {
    const ColumnGrid grid = column_grid(layers, bottom, options.grid);
    const auto n = static_cast<Index>(grid.size());
    const VectorXd capacity = VectorXd::Map(grid.capacity.data(), n);
    const MatrixXd k = conduction(grid);
    MatrixXd basis(n, 0);
    extend(basis, capacity, VectorXd::Ones(n));
    if (grid.conductance.back() > 0.0) extend(basis, capacity, response(grid, 0.0).real());
    double period = std::min(options.grid.period, options.longest);
    for (;;) {
        const Eigen::VectorXcd wave = response(grid, {0.0, 2.0 * std::numbers::pi / period});
        const Index before = basis.cols();
        extend(basis, capacity, wave.real());
        extend(basis, capacity, wave.imag());
        ReducedColumn column = project(grid, reference, k, basis);
        double worst = 0.0;
        for (const double p : periods(options.longest)) {
            const double error = std::max(
                error_at(column, layers, bottom, p, options.grid) / options.largest_error,
                kelvin_at(column, layers, bottom, p, options.grid) / options.largest_kelvin);
            if (error > worst) {
                worst = error;
                period = p;
            }
        }
        if (worst <= 1.0 || basis.cols() >= std::min(options.most, n) || basis.cols() == before) {
            return column;
        }
    }
}

ClosedColumn close_column(const ReducedColumn& column, double film) {
    MatrixXd k = film * column.surface * column.surface.transpose();
    k += column.rate.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(k);
    return {.film = film,
            .rate = eigen.eigenvalues(),
            .surface = eigen.eigenvectors().transpose() * column.surface,
            .turn = eigen.eigenvectors()};
}

}  // namespace diurna
