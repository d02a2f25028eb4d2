#include "thermal/solve/network_period.hpp"

#include <Eigen/QR>
#include <algorithm>

namespace diurna {

std::vector<double> NetworkPeriod::next(const std::vector<double>& start,
                                        const std::vector<double>& end) {
    start_.push_back(Eigen::Map<const Eigen::VectorXd>(start.data(), Eigen::Index(start.size())));
    end_.push_back(Eigen::Map<const Eigen::VectorXd>(end.data(), Eigen::Index(end.size())));
    const std::size_t n = end_.size(), used = std::min<std::size_t>(n - 1, 3);
    Eigen::VectorXd mixed = end_.back();
    if (used > 0) {
        Eigen::MatrixXd change(mixed.size(), Eigen::Index(used)), moved = change;
        const Eigen::VectorXd missing = end_.back() - start_.back();
        for (std::size_t k = 0; k < used; ++k) {
            const std::size_t a = n - 1 - k, b = a - 1;
            moved.col(Eigen::Index(k)) = end_[a] - end_[b];
            change.col(Eigen::Index(k)) = (end_[a] - start_[a]) - (end_[b] - start_[b]);
        }
        mixed -= moved * change.colPivHouseholderQr().solve(missing);
    }
    return {mixed.data(), mixed.data() + mixed.size()};
}

DeepColumns::DeepColumns(const HeatNetwork& network, const NetworkSystem& system)
    : network_(network) {
    for (std::size_t f = 0; f < network.facet.size(); ++f) {
        const NetworkFacet& facet = network.facet[f];
        const bool joined = facet.edge[0][0] != no_number || facet.edge[1][0] != no_number ||
                            std::any_of(facet.lump.begin(), facet.lump.end(),
                                        [](std::uint32_t lump) { return lump != no_number; });
        const std::size_t nodes = network.grid_of(f).size();
        if (!joined && nodes > 1) deep_.push_back({f, system.node_of(f), {}});
    }
    begin();
}

void DeepColumns::begin() {
    steps_ = 0.0;
    for (Deep& deep : deep_) deep.sum.assign(network_.grid_of(deep.facet).size(), 0.0);
}

void DeepColumns::add(const NetworkState& state) {
    steps_ += 1.0;
    for (Deep& deep : deep_) {
        for (std::size_t j = 0; j < deep.sum.size(); ++j) {
            deep.sum[j] += state.node[deep.node + j];
        }
    }
}

void DeepColumns::settle(std::vector<double>& end) const {
    for (const Deep& deep : deep_) {
        const ColumnGrid& grid = network_.grid_of(deep.facet);
        const std::size_t last = grid.size() - 1;
        double resistance = 0.0;
        for (std::size_t j = 0; j < last; ++j) resistance += 1.0 / grid.conductance[j];
        const double surface = deep.sum[0] / steps_;
        // What rises: all that comes from below.
        double rising = grid.below_flux;
        if (const double below = grid.conductance.back(); below > 0.0) {
            rising = (grid.below_flux + below * (grid.below_temperature - surface)) /
                     (1.0 + below * resistance);
        }
        double steady = surface;
        for (std::size_t j = 1; j <= last; ++j) {
            steady += rising / grid.conductance[j - 1];
            end[deep.node + j] += steady - deep.sum[j] / steps_;
        }
    }
}

}  // namespace diurna
