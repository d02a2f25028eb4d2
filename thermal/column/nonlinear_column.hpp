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

/// One layered column whose conductivity and heat may depend on temperature, water that freezes
/// included: the point tool's engine. The same nodes and links as thermal/column/column.hpp.
///
/// Its state is one number a node, `u`: kelvin from the reference, which keeps a digit more of a
/// short step; from 273.15 K where there is water, and then u = 0 to 1 is spent in melting. Heat
/// content h(u) and temperature T(u) are explicit functions, and what steps is h, so that every
/// step conserves energy whatever the laws do. Links conduct by differences of Kirchhoff's ∫k dT,
/// exact for steady profiles inside a layer, also with a front between ice and water on the link.
class NonlinearColumn {
 public:
    NonlinearColumn(std::span<const Layer> layers, const Bottom& bottom, double reference,
                    const GridOptions& options = {});

    std::size_t size() const { return depth_.size(); }
    double depth(std::size_t node) const { return depth_[node]; }
    bool linear() const { return linear_; }
    /// Its nodes and links as plain numbers; not of regolith.
    EnthalpyColumn enthalpy() const;
    /// Whether a node's u from 0 to 1 is spent in melting water that stays.
    bool melts(std::size_t node) const { return node_[node].latent > 0.0 && !node_[node].drains; }

    double temperature(std::size_t node, double u) const;
    double state_of(std::size_t node, double temperature) const;  // ice at the melting point
    /// Heat taken up from `u` to `u + by` [J m⁻²], to the last digit of `by` however small.
    double gain(std::size_t node, double u, double by) const;
    /// The way from one state of a node to another, as far as the first place where melting begins
    /// or ends.
    double up_to_kink(std::size_t node, double from, double to) const;
    /// Lets meltwater above what snow holds run off; returns the heat it had taken to melt [J m⁻²].
    double drain(std::vector<double>& u) const;

    /// What a step is given; arrays per stage, at step·γ and at the step's end.
    struct StepForcing {
        double duration;      // [s]
        bool gentle = false;  // backward Euler in place of SDIRK2: the second stage alone
        std::array<const Boundary*, 2> top{};
        std::array<const Boundary*, 2> back{};  // in place of what the column's bottom is
        /// Heat released at the nodes [W m⁻²], where any is.
        std::array<const std::vector<double>*, 2> source{};
    };
    struct Step {
        bool solved = true;
        int iterations = 0;
        double heat_in = 0.0;  // [J m⁻²] through both ends, from the balances at the stages
        double through = 0.0;  // [J m⁻²] Σ of their magnitudes
        std::array<double, 2> surface{};  // [K] at the stages
        double taken = 0.0;  // [W m⁻²] at the second, through the surface: what its node stored and
                             // passed on
    };
    /// One step of the state. With `map`, its columns are carried along by the linearised step.
    /// `rest`: what of the state its doubles no longer hold (compensated summation): without it a
    /// short step loses up to Σ C ulp(u), a millionth of a millisecond's heat in ten metres of
    /// ground.
    Step advance(const StepForcing& forcing, std::vector<double>& u, Eigen::MatrixXd* map = nullptr,
                 std::vector<double>* rest = nullptr) const;

 private:
    struct NodeHeat {
        double zero = 0.0;                  // [K] where u is 0
        double thawed = 0.0, frozen = 0.0;  // [J m⁻² K⁻¹]
        double latent = 0.0;                // [J m⁻²]
        bool drains = false;                // of snow
        double held = 0.0;                  // of `latent`, what snow's pores hold back
        double mass = 0.0;                  // [kg m⁻²] with a polynomial heat capacity
        HeatPolynomial polynomial{};
    };
    struct Link {
        double per_width = 0.0;  // [m⁻¹]
        double frozen = 0.0, thawed = 0.0, cubic = 0.0;
    };
    /// ∫k dT of a link from melting on [W m⁻¹] and its derivative, the conductivity.
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

    /// A step on its way: the state it set out from and how far each node has come since. What is
    /// solved for is `by`, so that no equation rests on the last digits of a temperature.
    struct Way {
        std::vector<double> begin, by;
        std::vector<double>
            apart;  // (node) [K] by which what lies under it is warmer at the beginning
        double u(std::size_t i) const { return begin[i] + by[i]; }
    };
    /// Heat up the link from node i + 1 to node i [W m⁻²].
    double conducted(const Way& way, std::size_t i) const;
    static double conducted(const Link& link, double high, double low, double apart);
    /// Heat into the last node, `by` from where it began, from what the bottom is [W m⁻²]; `back`
    /// replaces it if given.
    BoundaryFlux from_below(const Way& way, double by, const Boundary* back) const;
    /// An implicit stage: heat content = `target` + tau · fluxes.
    struct Stage {
        double tau;                   // [s]
        std::vector<double>& target;  // (node) [J m⁻²] above that at the beginning
        const Boundary& top;
        const Boundary* back;
    };
    struct Below;  // what lies under the surface node, eliminated
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
    Link below_link_;  // to a fixed temperature, where there is one
    bool below_is_link_ = false, linear_ = true;
};

}  // namespace diurna
