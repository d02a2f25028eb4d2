#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/origin.hpp"

namespace diurna {

/// A few spectra (modes) that all a scene sends out in a band is a sum of, orthonormal under the
/// band's quadrature: Σ_n weight_n φ_j(n) φ_k(n) = δ_jk. A spectrum then is a handful of numbers,
/// and what becomes of it (reflection, air, response) acts on each mode once and for all, node by
/// node: nothing is averaged inside a channel of the atmosphere.
///
/// Chosen from sample spectra by Gram-Schmidt with pivoting: the one worst represented becomes the
/// next mode. The first `thermal` modes hold black bodies over the scene's temperatures; the first
/// of all is the black body at the middle temperature, so that an isothermal scene stays exactly
/// isothermal. Other light needs to be represented only as far as its receivers can tell: what they
/// reflect of the rest is to be nothing.
///
/// What of a spectrum is sunlight, and what is heat of the sky, goes along with it: surfaces do the
/// same to all origins, the air before the eye does not (origin.hpp). As it is only by a tenth or
/// so that their shares differ, one shape does for each, the mean of its samples, in a mode of its
/// own.
struct SpectralBasis {
    Eigen::VectorXd root_weight;  // (node) √weight
    /// (node, mode) √weight × φ; below that, what of it is sunlight, and what is heat of the sky
    Eigen::MatrixXd mode;
    std::size_t thermal = 0;  // leading modes that black bodies need; from surfaces alone

    std::size_t size() const { return static_cast<std::size_t>(mode.cols()); }
    /// √weight × what comes of each origin at a node, of a column of `mode` or a sum of such.
    template <class Column>
    std::array<double, origin_count> by_origin(const Column& column, std::size_t node) const {
        const auto at = static_cast<Eigen::Index>(node), nodes = root_weight.size();
        const double sunlight = column[nodes + at], sky_heat = column[2 * nodes + at];
        return {column[at] - sunlight - sky_heat, sunlight, sky_heat};
    }
};

/// black      (sample)(node) black bodies; the first becomes the first mode
/// fine       bound on √Σ weight (rest)² of any of them
/// light      (sample) what else the scene sends out
/// receivers  (receiver)(node) what may become of it
/// coarse     bound on Σ weight × receiver × rest of any light and receiver
SpectralBasis spectral_basis(const Band& band, std::span<const std::vector<double>> black,
                             double fine, std::span<const LightByOrigin> light,
                             std::span<const std::vector<double>> receivers, double coarse);

/// Coefficients of light given per node (of its projection, if it is not a sum of modes).
Eigen::VectorXd project(const SpectralBasis& basis, const LightByOrigin& light);
/// Multiplication by a factor per node, the same for every origin: (mode out, mode in).
Eigen::MatrixXd product(const SpectralBasis& basis, std::span<const double> factor);

}  // namespace diurna
