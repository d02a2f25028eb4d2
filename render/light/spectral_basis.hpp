#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/origin.hpp"

namespace diurna {

/// A few spectra (modes) whose sums represent all light that a scene emits and reflects in a band,
/// orthonormal under the band's quadrature: Σ_n weight_n φ_j(n) φ_k(n) = δ_jk. A spectrum is then a
/// few numbers, and operations on it (reflection, air, response) are computed once for each mode,
/// node by node: nothing is averaged inside a channel of the atmosphere.
///
/// Chosen from sample spectra by Gram-Schmidt with pivoting: the one with the largest residual
/// becomes the next mode. The first `thermal` modes hold black bodies over the scene's
/// temperatures; the very first is the black body at the middle temperature, so that an isothermal
/// scene stays exactly isothermal. Other light is represented only as accurately as its receivers
/// need: their response to the residual is to be negligible.
///
/// Each mode also has its shares of sunlight and of the sky's thermal light: surfaces treat
/// all origins equally, the air before the eye does not (origin.hpp). As the shares differ
/// only by a tenth or so, one shape is used for each, the mean of its samples, in a separate
/// mode.
struct SpectralBasis {
    Eigen::VectorXd root_weight;  // (node) √weight
    /// (node, mode) √weight × φ; below it, its parts of sunlight and of the sky's
    /// heat
    Eigen::MatrixXd mode;
    std::size_t thermal = 0;  // leading modes for black bodies; from surfaces only

    std::size_t size() const { return static_cast<std::size_t>(mode.cols()); }
    /// √weight × the part of each origin at a node, of a column of `mode` or a sum of such.
    template <class Column>
    std::array<double, origin_count> by_origin(const Column& column, std::size_t node) const {
        const auto at = static_cast<Eigen::Index>(node), nodes = root_weight.size();
        const double sunlight = column[nodes + at], sky_heat = column[2 * nodes + at];
        return {column[at] - sunlight - sky_heat, sunlight, sky_heat};
    }
};

/// black      (sample)(node) black bodies; the first becomes the first mode
/// fine       bound on √Σ weight (rest)² of any of them
/// light      (sample) other light of the scene
/// receivers  (receiver)(node) operations that may be applied to it
/// coarse     bound on Σ weight × receiver × residual of any light and receiver
SpectralBasis spectral_basis(const Band& band, std::span<const std::vector<double>> black,
                             double fine, std::span<const LightByOrigin> light,
                             std::span<const std::vector<double>> receivers, double coarse);

/// Coefficients of light given per node (by projection if it is not a sum of modes).
Eigen::VectorXd project(const SpectralBasis& basis, const LightByOrigin& light);
/// Multiplication by a factor per node, the same for every origin: (mode out, mode in).
Eigen::MatrixXd product(const SpectralBasis& basis, std::span<const double> factor);

}  // namespace diurna
