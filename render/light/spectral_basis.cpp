#include "render/light/spectral_basis.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

using Samples = Eigen::MatrixXd;  // (node, sample) √weight × spectrum

Samples weighted(const Eigen::VectorXd& root_weight, std::span<const std::vector<double>> spectra,
                 double least) {
    Samples samples(root_weight.size(), static_cast<Eigen::Index>(spectra.size()));
    Eigen::Index kept = 0;
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        const Eigen::Map<const Eigen::VectorXd> spectrum(spectra[k].data(), root_weight.size());
        samples.col(kept) = root_weight.cwiseProduct(spectrum);
        // The first is kept for its place.
        if (k == 0 || samples.col(kept).norm() > least) ++kept;
    }
    samples.conservativeResize(Eigen::NoChange, kept);
    return samples;
}

/// √weight × light as a column of SpectralBasis::mode.
Eigen::VectorXd weighted(const Eigen::VectorXd& root_weight, const LightByOrigin& light) {
    const Eigen::Index nodes = root_weight.size();
    Eigen::VectorXd column = Eigen::VectorXd::Zero(nodes * Eigen::Index(origin_count));
    for (std::size_t origin = 0; origin < origin_count; ++origin) {
        if (light[origin].empty()) continue;
        const Eigen::Map<const Eigen::VectorXd> spectrum(light[origin].data(), nodes);
        const Eigen::VectorXd part = root_weight.cwiseProduct(spectrum);
        column.head(nodes) += part;
        if (origin > 0) column.segment(Eigen::Index(origin) * nodes, nodes) = part;
    }
    return column;
}

/// Adds the rest of a sample as a mode.
void add_mode(Samples& rest, Eigen::Index sample, Eigen::MatrixXd& mode) {
    Eigen::VectorXd next = rest.col(sample);
    // Once more against the earlier modes: rounding grows where little is left.
    next -= mode * (mode.transpose() * next).eval();
    next.normalize();
    const Eigen::RowVectorXd along = next.transpose() * rest;
    rest.noalias() -= next * along;
    rest.col(sample).setZero();
    mode.conservativeResize(Eigen::NoChange, mode.cols() + 1);
    mode.col(mode.cols() - 1) = next;
}

/// Samples that are copies of each other leave rounding, not a direction.
double rounding(const Samples& samples) {
    return samples.cols() > 0 ? 1e-12 * samples.colwise().norm().maxCoeff() : 0.0;
}

/// Below the modes of whole spectra, and beside them, a mode for each origin that there is light
/// of.
///
/// - columns: (row of SpectralBasis::mode, sample)
void add_origins(const Samples& columns, Eigen::MatrixXd& mode) {
    const Eigen::Index nodes = mode.rows();
    mode.conservativeResize(columns.rows(), Eigen::NoChange);
    mode.bottomRows(columns.rows() - nodes).setZero();
    for (Eigen::Index first = nodes; first < columns.rows(); first += nodes) {
        const Eigen::VectorXd mean = columns.middleRows(first, nodes).rowwise().sum();
        if (!(mean.norm() > 0.0)) continue;
        mode.conservativeResize(Eigen::NoChange, mode.cols() + 1);
        mode.rightCols(1).setZero();
        mode.col(mode.cols() - 1).segment(first, nodes) = mean.normalized();
    }
}

}  // namespace

SpectralBasis spectral_basis(const Band& band, std::span<const std::vector<double>> black,
                             double fine, std::span<const LightByOrigin> light,
                             std::span<const std::vector<double>> receivers, double coarse) {
    SpectralBasis basis;
    const auto nodes = static_cast<Eigen::Index>(band.node_um.size());
    basis.root_weight = Eigen::Map<const Eigen::VectorXd>(band.weight.data(), nodes).cwiseSqrt();
    basis.mode.resize(nodes, 0);

    Samples rest = weighted(basis.root_weight, black, fine);
    const double floor = rounding(rest);
    Eigen::Index worst = 0;
    double left = rest.col(0).norm();
    while (left > (basis.size() == 0 ? 0.0 : std::max(fine, floor))) {
        add_mode(rest, worst, basis.mode);
        left = rest.colwise().norm().maxCoeff(&worst);
    }
    basis.thermal = basis.size();

    const Samples received = weighted(basis.root_weight, receivers, 0.0);
    Samples columns(nodes * Eigen::Index(origin_count), static_cast<Eigen::Index>(light.size()));
    for (std::size_t k = 0; k < light.size(); ++k) {
        columns.col(static_cast<Eigen::Index>(k)) = weighted(basis.root_weight, light[k]);
    }
    rest = columns.topRows(nodes);
    const double light_floor = rounding(rest);
    rest -= basis.mode * (basis.mode.transpose() * rest).eval();
    while (rest.cols() > 0) {
        const Eigen::RowVectorXd wrong =
            (received.transpose() * rest).cwiseAbs().colwise().maxCoeff();
        const double most = wrong.maxCoeff(&worst);
        if (most <= coarse || rest.col(worst).norm() <= light_floor) break;
        add_mode(rest, worst, basis.mode);
    }
    if (basis.size() == 0) basis.mode.setZero(nodes, 1);  // nothing shines
    add_origins(columns, basis.mode);
    return basis;
}

Eigen::VectorXd project(const SpectralBasis& basis, const LightByOrigin& light) {
    return basis.mode.transpose() * weighted(basis.root_weight, light);
}

Eigen::MatrixXd product(const SpectralBasis& basis, std::span<const double> factor) {
    const Eigen::Map<const Eigen::VectorXd> f(factor.data(), basis.root_weight.size());
    return basis.mode.transpose() * f.replicate(Eigen::Index(origin_count), 1).asDiagonal() *
           basis.mode;
}

}  // namespace diurna
