#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "materials/base/parallel.hpp"
#include "thermal/network/heat_network.hpp"
#include "thermal/network/sparse_factor.hpp"

namespace diurna {

/// Temperatures of a network [K].
struct NetworkState {
    std::vector<double> node;  // facet by facet, outer end first
    std::vector<double> lump;
    std::vector<double> edge;  // derived from the others; a guess
};

/// A linearised implicit stage of a network, J δ = r, with the nodes eliminated: one equation
/// remains for each edge and lump, solved by conjugate gradients (stabilised bi-conjugate gradients
/// if streams make it unsymmetric). The preconditioner is the Cholesky factor of an earlier stage
/// with similar slopes: four iterations where the diagonal takes forty on a truck's sheets.
class NetworkSystem {
 public:
    explicit NetworkSystem(const HeatNetwork& network);
    NetworkSystem(const NetworkSystem&) = delete;  // Given holds a reference to it
    NetworkSystem& operator=(const NetworkSystem&) = delete;

    std::size_t nodes() const { return first_.back(); }
    /// The first node of a facet.
    std::size_t node_of(std::size_t facet) const { return first_[facet]; }
    std::size_t last_of(std::size_t facet) const { return first_[facet + 1] - 1; }

    /// The touches of a facet.
    std::span<const HeatTouch> touches_of(std::size_t f) const {
        return std::span(network_.touch).subspan(touch_[f], touch_[f + 1] - touch_[f]);
    }

    /// Contributions of facets to their edges and lumps, so that threads can process facets in
    /// parallel: each writes to separate places, which are summed in a fixed order.
    class Given {
     public:
        explicit Given(const NetworkSystem& system);

        /// Calls body(block, begin, end) for blocks of facets, on many threads.
        template <class Body>
        void of_facets(const Body& body) {
            std::fill(lump_.begin(), lump_.end(), 0.0);
            for_each_block(system_.facet_.size(), at_once, [&](std::size_t begin, std::size_t end) {
                body(begin / at_once, begin, end);
            });
        }
        double& to_edge(std::size_t f, int end, int side) {
            return edge_[6 * f + 3 * std::size_t(end) + std::size_t(side)];
        }
        /// touch  index into the network's
        double& to_touched(std::size_t touch) { return edge_[6 * system_.facet_.size() + touch]; }
        double& to_lump(std::size_t block, std::uint32_t lump) {
            return lump_[block * lumps_ + lump];
        }
        /// Adds all of it up, (edge) and (lump).
        void add_to(double* edge, double* lump) const;
        std::size_t blocks() const { return (system_.facet_.size() + at_once - 1) / at_once; }

     private:
        static constexpr std::size_t at_once = 512;
        const NetworkSystem& system_;
        std::size_t lumps_;
        std::vector<double> edge_, lump_;  // (place), (block, lump)
    };

    /// Coefficients of each facet's ends for an implicit stage, at the present temperatures.
    struct Ends {
        std::span<const double> outer_slope, inner_slope;  // (facet) d(flux)/dT [W m⁻² K⁻¹]
        std::span<const double> to_star;  // (facet) [W m⁻² K⁻¹] σ R (T² + T*²)(T + T*)
    };
    /// tau  [s] of the stage
    void factorise(double tau, const Ends& ends);

    /// Residual of each equation [W].
    struct Residual {
        std::vector<double> node, edge, lump;
    };
    /// residual → δ [K], in place. Returns the iterations.
    int solve(Residual& residual, double relative_error);

 private:
    /// Upward through a facet's column: what its outer and inner end would do alone.
    void eliminate_column(std::size_t block, std::size_t f, std::vector<double>& node);
    /// Back down it, its edges and lumps known.
    void follow_column(std::size_t f, const std::vector<double>& x,
                       std::vector<double>& node) const;
    /// A facet with its nodes eliminated: inverse of their matrix between its ends [K W⁻¹].
    struct Condensed {
        double outer, across, inner;
        std::array<double, behinds> to;  // [W K⁻¹] its lumps
        std::array<double, 2> spread;
    };
    std::size_t unknowns() const { return network_.edges + network_.lump.size(); }
    void find_places();
    void condense(std::size_t f, double tau, const Ends& ends);
    void apply(const std::vector<double>& x, std::vector<double>& y);
    /// The factor for steps of about this length, else the other one, outdated.
    std::size_t factor_for(double tau) const;
    /// Factorises the remaining matrix.
    void prepare();
    int conjugate_gradients(const std::vector<double>& b, std::vector<double>& x, double error);
    int stabilised(const std::vector<double>& b, std::vector<double>& x, double error);

    const HeatNetwork& network_;
    std::vector<std::size_t> first_;  // (facet + 1) node
    std::vector<std::size_t> touch_;  // (facet + 1) first touch
    /// (edge + 1), and owner: places of Given where facets write the edge's contributions.
    std::vector<std::uint32_t> first_place_, place_;
    double tau_ = 1.0;
    std::vector<double> pivot_;    // (node) of the columns' elimination from the inner end outward
    std::vector<double> follows_;  // (node) δ of it per δ of the node before it
    std::vector<Condensed> facet_;
    std::vector<double> lump_own_;  // [W K⁻¹] C/τ
    /// Of the remaining matrix, for steps of one length and of another.
    struct Factor {
        SparseFactor of{};
        double tau = 0.0;  // [s] at factorisation; 0: none, or outdated
    };
    std::array<Factor, 2> factor_;
    std::size_t now_ = 0;  // the factor in use
    Given given_;
};

}  // namespace diurna
