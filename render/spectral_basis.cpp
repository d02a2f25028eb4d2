#include "render/spectral_basis.hpp"

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

/// Adds modes until no sample has a rest of more than `tolerance`; returns the worst rest.
double add_modes(Samples& rest, double tolerance, bool first_comes_first, Eigen::MatrixXd& mode) {
    for (Eigen::Index turn = 0; turn < rest.cols(); ++turn) {
        Eigen::Index worst = 0;
        double left = rest.colwise().norm().maxCoeff(&worst);
        if (turn == 0 && first_comes_first) {
            worst = 0;
            left = rest.col(0).norm();
        } else if (left <= tolerance) {
            return left;
        }
        if (!(left > 0.0)) return left;
        Eigen::VectorXd next = rest.col(worst);
        // Once more against the earlier modes: rounding grows where little is left.
        next -= mode * (mode.transpose() * next).eval();
        next.normalize();
        const Eigen::RowVectorXd along = next.transpose() * rest;
        rest.noalias() -= next * along;
        mode.conservativeResize(Eigen::NoChange, mode.cols() + 1);
        mode.col(mode.cols() - 1) = next;
    }
    return rest.cols() > 0 ? rest.colwise().norm().maxCoeff() : 0.0;
}

}  // namespace

SpectralBasis spectral_basis(const Band& band, std::span<const std::vector<double>> black,
                             double fine, std::span<const std::vector<double>> light,
                             double coarse) {
    SpectralBasis basis;
    const auto nodes = static_cast<Eigen::Index>(band.node_um.size());
    basis.root_weight = Eigen::Map<const Eigen::VectorXd>(band.weight.data(), nodes).cwiseSqrt();
    basis.mode.resize(nodes, 0);
    Samples rest = weighted(basis.root_weight, black, fine);
    // Samples that are copies of each other leave rounding, not a direction.
    const auto rounding = [&] {
        return rest.cols() > 0 ? 1e-12 * rest.colwise().norm().maxCoeff() : 0.0;
    };
    fine = std::max(fine, rounding());
    basis.error = add_modes(rest, fine, true, basis.mode);
    basis.thermal = basis.size();
    rest = weighted(basis.root_weight, light, coarse);
    coarse = std::max(coarse, rounding());
    rest -= basis.mode * (basis.mode.transpose() * rest).eval();
    basis.error = std::max(basis.error, add_modes(rest, coarse, false, basis.mode));
    if (basis.size() == 0) basis.mode.setZero(nodes, 1);  // nothing shines
    return basis;
}

Eigen::VectorXd project(const SpectralBasis& basis, std::span<const double> spectrum) {
    const Eigen::Map<const Eigen::VectorXd> s(spectrum.data(), basis.root_weight.size());
    return basis.mode.transpose() * basis.root_weight.cwiseProduct(s);
}

Eigen::MatrixXd product(const SpectralBasis& basis, std::span<const double> factor) {
    const Eigen::Map<const Eigen::VectorXd> f(factor.data(), basis.root_weight.size());
    return basis.mode.transpose() * f.asDiagonal() * basis.mode;
}

}  // namespace diurna
