#include "thermal/solve/network_period.hpp"

#include <algorithm>

namespace diurna {

NetworkPeriod::NetworkPeriod(const HeatNetwork& network) : network_(network), system_(network) {
    begin();
}

void NetworkPeriod::begin() {
    steps_ = 0.0;
    for (std::vector<double>* of : {&outer_, &inner_, &to_star_}) {
        of->assign(network_.facet.size(), 0.0);
    }
}

void NetworkPeriod::add(const NetworkStepper& stepper) {
    const NetworkSystem::Ends slopes = stepper.slopes();
    steps_ += 1.0;
    for (std::size_t f = 0; f < outer_.size(); ++f) {
        outer_[f] += slopes.outer_slope[f];
        inner_[f] += slopes.inner_slope[f];
        to_star_[f] += slopes.to_star[f];
    }
}

/// [W] that a change of temperatures stores within some time.
void NetworkPeriod::heat_of(const std::vector<double>& change, double over,
                            NetworkSystem::Residual& heat) const {
    heat.node.assign(system_.nodes(), 0.0);
    heat.edge.assign(network_.edges, 0.0);
    heat.lump.assign(network_.lump.size(), 0.0);
    for (std::size_t f = 0; f < network_.facet.size(); ++f) {
        const ColumnGrid& grid = network_.grid_of(f);
        const std::size_t at = system_.node_of(f);
        for (std::size_t j = 0; j < grid.size(); ++j) {
            heat.node[at + j] = network_.facet[f].area * grid.capacity[j] / over * change[at + j];
        }
    }
    for (std::size_t k = 0; k < heat.lump.size(); ++k) {
        heat.lump[k] = network_.lump[k].capacity / over * change[system_.nodes() + k];
    }
}

std::vector<double> NetworkPeriod::next(const std::vector<double>& start,
                                        const std::vector<double>& end, double span) {
    constexpr double at_rest = 1e12;                        // [s]
    constexpr double linear_error = 1e-6, farthest = 50.0;  // [K]
    for (std::vector<double>* of : {&outer_, &inner_, &to_star_}) {
        for (double& slope : *of) slope /= std::max(1.0, steps_);
    }
    steps_ = 1.0;
    std::vector<double> change(end.size());
    for (std::size_t k = 0; k < end.size(); ++k) change[k] = end[k] - start[k];
    NetworkSystem::Residual heat;
    for (const double tau : {at_rest, 0.5 * span}) {
        heat_of(change, tau == at_rest ? span : tau, heat);
        system_.factorise(tau, {outer_, inner_, to_star_});
        system_.solve(heat, linear_error);
        std::copy(heat.node.begin(), heat.node.end(), change.begin());
        std::copy(heat.lump.begin(), heat.lump.end(),
                  change.begin() + std::ptrdiff_t(heat.node.size()));
    }
    std::vector<double> next(end);
    for (std::size_t k = 0; k < end.size(); ++k) {
        next[k] += std::clamp(change[k], -farthest, farthest);
    }
    return next;
}

}  // namespace diurna
