#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "materials/matter/material.hpp"
#include "thermal/column/column.hpp"
#include "thermal/column/enthalpy_column.hpp"

namespace diurna {

/// Heat into a boundary of a column [W m⁻²] at its temperature, and d/dT (zero or negative).
struct BoundaryFlux {
    double flux = 0.0, slope = 0.0;
};
using Boundary = std::function<BoundaryFlux(double temperature)>;

/// One layered column whose conductivity and heat capacity may depend on temperature, with freezing
/// water: used by the point tool. Same nodes and links as thermal/column/column.hpp.
///
/// Its state is one number per node, `u`: kelvin from the reference, which gains a digit in short
/// steps; from 273.15 K if there is water, and then u = 0 to 1 is the melting. Heat content h(u)
/// and temperature T(u) are explicit functions, and h is integrated, so that every step conserves
/// energy for any law. Links conduct by differences of Kirchhoff's ∫k dT, exact for steady profiles
/// inside a layer, also with a front between ice and water on the link.
class NonlinearColumn {
 public:
    NonlinearColumn(std::span<const Layer> layers, const Bottom& bottom, double reference,
                    const GridOptions& options = {});

    std::size_t size() const { return depth_.size(); }
    double depth(std::size_t node) const { return depth_[node]; }
    bool linear() const { return linear_; }
    /// Its nodes and links as plain numbers; not for regolith.
    EnthalpyColumn enthalpy() const;
    /// Whether u from 0 to 1 is the melting of a node's water that stays.
    bool melts(std::size_t node) const { return node_[node].latent > 0.0 && !node_[node].drains; }

    double temperature(std::size_t node, double u) const;
    double state_of(std::size_t node, double temperature) const;  // ice at the melting point
    /// Heat gained from `u` to `u + by` [J m⁻²], with full relative accuracy in `by`.
    double gain(std::size_t node, double u, double by) const;
    /// The change from one state of a node towards another, limited to the first point where
    /// melting begins or ends.
    double up_to_kink(std::size_t node, double from, double to) const;
    /// Removes meltwater above the snow's capacity; returns the heat used to melt it [J m⁻²].
    double drain(std::vector<double>& u) const;

    /// Inputs of a step; arrays per stage, at step·γ and at the step's end.
    struct StepForcing {
        double duration;      // [s]
        bool gentle = false;  // backward Euler instead of SDIRK2: only the second stage
        std::array<const Boundary*, 2> top{};
        std::array<const Boundary*, 2> back{};  // replaces the column's bottom
        /// Heat released at the nodes [W m⁻²]; null: none.
        std::array<const std::vector<double>*, 2> source{};
    };
    struct Step {
        bool solved = true;
        int iterations = 0;
        double heat_in = 0.0;  // [J m⁻²] through both ends, from the balances at the stages
        double through = 0.0;  // [J m⁻²] Σ of their magnitudes
        std::array<double, 2> surface{};  // [K] at the stages
        double taken = 0.0;  // [W m⁻²] at the second stage, through the surface: stored in its
                             // node and passed on
    };
    /// One step of the state. With `map`, its columns are transformed by the linearised step.
    /// `rest`: the part of the state below double precision (compensated summation): without it a
    /// short step loses up to Σ C ulp(u), the heat of a millionth of a millisecond in ten metres of
    /// ground.
    Step advance(const StepForcing& forcing, std::vector<double>& u, Eigen::MatrixXd* map = nullptr,
                 std::vector<double>* rest = nullptr) const;

 private:
    struct NodeHeat {
        double zero = 0.0;                  // [K] where u is 0
        double thawed = 0.0, frozen = 0.0;  // [J m⁻² K⁻¹]
        double latent = 0.0;                // [J m⁻²]
        bool drains = false;                // snow
        double held = 0.0;                  // part of `latent` retained in snow's pores
        double mass = 0.0;                  // [kg m⁻²] with a polynomial heat capacity
        HeatPolynomial polynomial{};
    };
    struct Link {
        double per_width = 0.0;  // [m⁻¹]
        double frozen = 0.0, thawed = 0.0, cubic = 0.0;
    };
    /// ∫k dT of a link above the melting point [W m⁻¹] and its derivative, the conductivity.
    struct Potential {
        double value, slope;
    };
    static Potential potential(const Link& link, double temperature);
    static Link link_of(const Layer& layer, double width);
    static NodeHeat half_cell(const Layer& layer, double width);
    void add_cell(std::size_t upper, const Layer& layer, double width);
    static double heat_of_phase(const NodeHeat& node, double u);  // [J m⁻² K⁻¹], or per melt
    double heat_slope(std::size_t node, double u) const;
    double above_zero(std::size_t node, double u) const;         // [K] above NodeHeat::zero
    double warmed(std::size_t node, double u, double by) const;  // [K] from u to u + by
    double temperature_slope(std::size_t node, double u) const;

    /// State of a step in progress: the initial state and the change of each node. The unknown is
    /// `by`, so that no equation depends on the last digits of a temperature.
    struct Way {
        std::vector<double> begin, by;
        std::vector<double> apart;  // (node) [K] initial T of the node below minus its own
        double u(std::size_t i) const { return begin[i] + by[i]; }
    };
    /// Heat up the link from node i + 1 to node i [W m⁻²].
    double conducted(const Way& way, std::size_t i) const;
    static double conducted(const Link& link, double high, double low, double apart);
    /// Heat into the last node from the bottom [W m⁻²] after a change `by`; `back` replaces the
    /// bottom if given.
    BoundaryFlux from_below(const Way& way, double by, const Boundary* back) const;
    /// An implicit stage: heat content = `target` + tau · fluxes.
    struct Stage {
        double tau;                   // [s]
        std::vector<double>& target;  // (node) [J m⁻²] above the initial one
        const Boundary& top;
        const Boundary* back;
    };
    struct Below;  // the nodes under the surface node, eliminated
    bool solve_stage(const Stage& stage, Way& way, int& iterations) const;
    void eliminate_upward(const Stage& stage, const Way& way, Below& below) const;
    double solve_surface_node(const Stage& stage, const Below& below, const Way& way,
                              int& iterations) const;
    double follow_downward(const Below& below, double surface_rest, bool halting, Way& way) const;
    void set_out(const std::vector<double>& u, const std::vector<double>* rest, Way& way) const;
    void carry(const Stage& stage, const std::vector<double>& u, double top_slope,
               double bottom_slope, Eigen::MatrixXd& right) const;

    std::vector<double> depth_;
    std::vector<NodeHeat> node_;
    std::vector<Link> link_;  // from node i to i + 1
    double below_conductance_ = 0.0, below_temperature_ = 0.0, below_flux_ = 0.0;
    Link below_link_;  // to a fixed temperature, if any
    bool below_is_link_ = false, linear_ = true;
};

}  // namespace diurna
