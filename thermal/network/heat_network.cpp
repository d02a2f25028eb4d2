#include "thermal/network/heat_network.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace diurna {

std::size_t HeatNetwork::first_touch(std::size_t f) const {
    const auto first =
        std::lower_bound(touch.begin(), touch.end(), f,
                         [](const HeatTouch& one, std::size_t of) { return one.facet < of; });
    return std::size_t(first - touch.begin());
}

SidewaysFlow sideways_flow(const std::array<double, 3>& side, double area) {
    // Flux basis (x − corner a) / 2A of unit outflow through side a. ∫(x − a)·(x − b) is
    // A ((c − a)·(c − b) + (l0² + l1² + l2²) / 36), c the centroid; dot products by the cosine law.
    const double l0 = side[0] * side[0], l1 = side[1] * side[1], l2 = side[2] * side[2];
    const double squares = l0 + l1 + l2;
    Eigen::Matrix3d resistance;
    const double length[3]{l0, l1, l2};
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            // |c − a|² = (2 (Σ l²) − 3 l_a²) / 9; |a − b|² = l² of the third side.
            const double to_a = (2.0 * squares - 3.0 * length[a]) / 9.0;
            const double to_b = (2.0 * squares - 3.0 * length[b]) / 9.0;
            const double apart = a == b ? 0.0 : length[3 - a - b];
            const double dot = 0.5 * (to_a + to_b - apart);
            resistance(a, b) = (dot + squares / 36.0) / (4.0 * area);
        }
    }
    const Eigen::Matrix3d flow = resistance.inverse();
    return {flow(0, 0), flow(0, 1), flow(0, 2), flow(1, 1), flow(1, 2), flow(2, 2)};
}

NetworkColumn network_column(const std::vector<Layer>& layers, const Bottom& bottom,
                             const GridOptions& options) {
    constexpr double thin = 1e-4;  // [m² K W⁻¹]: 0.03 K at 300 W/m²
    NetworkColumn column;
    double resistance = 0.0;
    for (const Layer& layer : layers) resistance += layer.thickness / layer.conductivity;
    column.grid = column_grid(layers, bottom, options);
    const bool open = column.grid.conductance.back() == 0.0;
    if (resistance < thin && open) {
        const double capacity = column.grid.total_capacity(), flux = column.grid.below_flux;
        column.grid = {.depth = {0.0}, .capacity = {capacity}, .conductance = {0.0}};
        column.grid.below_flux = flux;
    }
    double above = 0.0;
    for (const Layer& layer : layers) {
        const double own = layer.thickness / layer.conductivity;
        const double half = 0.5 * resistance;
        const double outer = std::clamp((half - above) / own, 0.0, 1.0);
        const double spread = layer.conductivity * layer.thickness;
        const bool one = column.grid.size() == 1;
        column.spread[0] += one ? spread : outer * spread;
        column.spread[1] += one ? 0.0 : (1.0 - outer) * spread;
        above += own;
    }
    return column;
}

std::vector<double> carroll_factors(const std::vector<double>& area) {
    std::vector<double> factor(area.size(), 1.0);
    // A plane that is more than half of the whole sees itself in part: no F satisfies it.
    constexpr double most = 1e3;
    for (int i = 0; i < 200; ++i) {
        double all = 0.0;
        for (std::size_t p = 0; p < area.size(); ++p) all += area[p] * factor[p];
        for (std::size_t p = 0; p < area.size(); ++p) {
            const double next = 1.0 / std::max(1.0 / most, 1.0 - area[p] * factor[p] / all);
            factor[p] = 0.5 * (factor[p] + next);
        }
    }
    return factor;
}

double radiant_share(double carroll_factor, double emissivity) {
    if (!(emissivity > 0.0)) return 0.0;
    return 1.0 / (1.0 / carroll_factor + (1.0 - emissivity) / emissivity);
}

}  // namespace diurna
