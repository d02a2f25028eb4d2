#pragma once

#include <span>
#include <vector>

#include "thermal/network/heat_network.hpp"
#include "thermal/network/sparse_factor.hpp"

namespace diurna {

/// Temperatures of a network [K].
struct NetworkState {
    std::vector<double> node;  // facet by facet, outer end first
    std::vector<double> lump;
    std::vector<double> edge;  // follow from the others; a guess
};

/// A linearised implicit stage of a network, J δ = r, node by node eliminated: what is left is one
/// equation for each edge and lump, solved by conjugate gradients (by stabilised bi-conjugate ones
/// where streams make it unsymmetric). Before them goes the Cholesky factor of an earlier stage of
/// about the same slopes: four iterations where the diagonal alone takes forty on a truck's sheets.
class NetworkSystem {
 public:
    explicit NetworkSystem(const HeatNetwork& network);

    std::size_t nodes() const { return first_.back(); }
    /// The first node of a facet.
    std::size_t node_of(std::size_t facet) const { return first_[facet]; }
    std::size_t last_of(std::size_t facet) const { return first_[facet + 1] - 1; }

    /// The touches of a facet.
    std::span<const HeatTouch> touches_of(std::size_t f) const {
        return std::span(network_.touch).subspan(touch_[f], touch_[f + 1] - touch_[f]);
    }

    /// What an implicit stage asks of each facet's ends, at the present temperatures.
    struct Ends {
        std::span<const double> outer_slope, inner_slope;  // (facet) d(flux)/dT [W m⁻² K⁻¹]
        std::span<const double> to_star;  // (facet) [W m⁻² K⁻¹] σ R (T² + T*²)(T + T*)
    };
    /// tau  [s] of the stage
    void factorise(double tau, const Ends& ends);

    /// What is missing from each equation [W].
    struct Residual {
        std::vector<double> node, edge, lump;
    };
    /// residual → δ [K] in its place. Returns the iterations.
    int solve(Residual& residual, double relative_error);

 private:
    /// A facet without its nodes: inverse of their matrix between its ends [K W⁻¹].
    struct Condensed {
        double outer, across, inner;
        std::array<double, behinds> to;  // [W K⁻¹] its lumps
        std::array<double, 2> spread;
    };
    std::size_t unknowns() const { return network_.edges + network_.lump.size(); }
    void column_of(std::size_t f, std::vector<double>& diagonal) const;
    void apply(const std::vector<double>& x, std::vector<double>& y) const;
    /// Factors what is left as it is now.
    void prepare();
    int conjugate_gradients(const std::vector<double>& b, std::vector<double>& x, double error);
    int stabilised(const std::vector<double>& b, std::vector<double>& x, double error);

    const HeatNetwork& network_;
    std::vector<std::size_t> first_;  // (facet + 1) node
    std::vector<std::size_t> touch_;  // (facet + 1) its first
    double tau_ = 1.0;
    std::vector<double> pivot_;    // (node) of the columns' elimination from the inner end outward
    std::vector<double> follows_;  // (node) δ of it per δ of the node before it
    std::vector<Condensed> facet_;
    std::vector<double> lump_own_;  // [W K⁻¹] C/τ
    SparseFactor factor_;           // of what was left
    double factored_tau_ = 0.0;     // [s] then; 0: none, or outworn
};

}  // namespace diurna
