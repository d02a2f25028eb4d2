#include "thermal/column/nonlinear_column.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

double polynomial(const HeatPolynomial& c, double t) {
    return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4])));
}

/// Mean of the polynomial between two temperatures: Σ c_k / (k + 1) Σ_j aʲ bᵏ⁻ʲ.
double polynomial_mean(const HeatPolynomial& c, double a, double b) {
    double sum = c[0], powers = 1.0, b_power = 1.0;
    for (std::size_t k = 1; k < c.size(); ++k) {
        b_power *= b;
        powers = powers * a + b_power;
        sum += c[k] / double(k + 1) * powers;
    }
    return sum;
}

}  // namespace

NonlinearColumn::NonlinearColumn(std::span<const Layer> layers, const Bottom& bottom,
                                 double reference, const GridOptions& options) {
    // The nodes of the linear column; a layer's boundaries are nodes, so each link has one layer.
    const ColumnGrid grid = column_grid(layers, bottom, options);
    const bool fixed = std::holds_alternative<FixedTemperature>(bottom);
    depth_ = grid.depth;
    node_.resize(grid.size() + (fixed ? 1 : 0));
    std::vector<double> bound = depth_;
    double bottom_depth = 0.0;
    for (const Layer& layer : layers) bottom_depth += layer.thickness;
    if (fixed) bound.push_back(bottom_depth);

    std::size_t l = 0;
    double layer_end = layers[0].thickness;
    for (std::size_t i = 0; i + 1 < bound.size(); ++i) {
        const double middle = 0.5 * (bound[i] + bound[i + 1]);
        while (middle > layer_end && l + 1 < layers.size()) layer_end += layers[++l].thickness;
        add_cell(i, layers[l], bound[i + 1] - bound[i]);
    }
    if (fixed) {
        node_.pop_back();
        below_link_ = link_.back();
        link_.pop_back();
        below_is_link_ = true;
        below_temperature_ = grid.below_temperature;
    } else {
        below_conductance_ = grid.conductance.back();
        below_temperature_ = grid.below_temperature;
        below_flux_ = grid.below_flux;
    }
    for (NodeHeat& node : node_) node.zero = node.latent > 0.0 ? zero_celsius : reference;
    assert(link_.size() + 1 == node_.size());
}

EnthalpyColumn NonlinearColumn::enthalpy() const {
    const auto plain = [](const Link& link) {
        return EnthalpyLink{link.per_width, link.frozen, link.thawed};
    };
    EnthalpyColumn column{.node = {},
                          .link = {},
                          .below_flux = below_flux_,
                          .below_conductance = below_conductance_,
                          .below_temperature = below_temperature_,
                          .below_is_link = below_is_link_,
                          .below_link = plain(below_link_)};
    for (const NodeHeat& n : node_) {
        assert(n.mass == 0.0);
        column.node.push_back({n.zero, n.thawed, n.frozen, n.latent, n.held, n.drains});
    }
    for (const Link& link : link_) column.link.push_back(plain(link));
    return column;
}

NonlinearColumn::Link NonlinearColumn::link_of(const Layer& layer, double width) {
    Link link{.per_width = 1.0 / width,
              .frozen = layer.conductivity,
              .thawed = layer.conductivity,
              .cubic = 0.0};
    if (const auto* radiating = std::get_if<Radiating>(&layer.law)) link.cubic = radiating->cubic;
    if (const auto* freezing = std::get_if<Freezing>(&layer.law)) {
        link.frozen = freezing->frozen_conductivity;
    }
    return link;
}

NonlinearColumn::NodeHeat NonlinearColumn::half_cell(const Layer& layer, double width) {
    NodeHeat half;
    const double mass = 0.5 * layer.density * width;
    half.thawed = half.frozen = mass * layer.heat_capacity;
    if (const auto* radiating = std::get_if<Radiating>(&layer.law)) {
        half.thawed = half.frozen = 0.0;
        half.mass = mass;
        half.polynomial = radiating->heat;
    } else if (const auto* freezing = std::get_if<Freezing>(&layer.law)) {
        half.frozen = mass * freezing->frozen_heat_capacity;
        half.latent = 0.5 * width * freezing->water * heat_of_fusion;
    } else if (const auto* melting = std::get_if<Melting>(&layer.law)) {
        half.latent = mass * heat_of_fusion;
        half.drains = true;
        half.held = melting->held * half.latent;
    }
    return half;
}

/// The cell between a node and the one below it: half of its heat to either, a link between them.
void NonlinearColumn::add_cell(std::size_t upper, const Layer& layer, double width) {
    const NodeHeat half = half_cell(layer, width);
    for (const std::size_t n : {upper, upper + 1}) {
        NodeHeat& node = node_[n];
        node.thawed += half.thawed;
        node.frozen += half.frozen;
        node.latent += half.latent;
        node.drains = node.drains || half.drains;
        node.held += half.held;
        if (half.mass > 0.0) {
            node.polynomial = half.polynomial;
            node.mass += half.mass;
        }
    }
    link_.push_back(link_of(layer, width));
    linear_ = linear_ && std::holds_alternative<Constant>(layer.law);
}

// (T21) of docs/theory.md: ∫k dT
NonlinearColumn::Potential NonlinearColumn::potential(const Link& link, double temperature) {
    const double theta = temperature - zero_celsius;
    if (link.cubic > 0.0) {
        const double cube = temperature * temperature * temperature;
        return {link.thawed * (theta + link.cubic * 0.25 * cube * temperature),
                link.thawed * (1.0 + link.cubic * cube)};
    }
    const double k = theta < 0.0 ? link.frozen : link.thawed;
    return {k * theta, k};
}

double NonlinearColumn::above_zero(std::size_t i, double u) const {
    const NodeHeat& node = node_[i];
    if (node.latent == 0.0 || u <= 0.0) return u;
    return node.drains || u < 1.0 ? 0.0 : u - 1.0;
}

double NonlinearColumn::temperature(std::size_t i, double u) const {
    return node_[i].zero + above_zero(i, u);
}

double NonlinearColumn::warmed(std::size_t i, double u, double by) const {
    const NodeHeat& node = node_[i];
    const double to = u + by;
    const bool one_phase =
        node.latent == 0.0 || (u <= 0.0 && to <= 0.0) || (u >= 1.0 && to >= 1.0 && !node.drains);
    return one_phase ? by : above_zero(i, to) - above_zero(i, u);
}

double NonlinearColumn::temperature_slope(std::size_t i, double u) const {
    const NodeHeat& node = node_[i];
    if (node.latent == 0.0 || u <= 0.0) return 1.0;
    return node.drains || u < 1.0 ? 0.0 : 1.0;
}

double NonlinearColumn::state_of(std::size_t i, double temperature) const {
    const NodeHeat& node = node_[i];
    const double theta = temperature - node.zero;
    if (node.latent == 0.0 || theta <= 0.0) return theta;
    return node.drains ? 0.0 : 1.0 + theta;
}

double NonlinearColumn::gain(std::size_t i, double u, double by) const {
    const NodeHeat& node = node_[i];
    const double to = u + by;
    const bool same = node.latent == 0.0 || (u <= 0.0 && to <= 0.0) ||
                      (u >= 0.0 && to >= 0.0 && (node.drains || (u <= 1.0 && to <= 1.0))) ||
                      (u >= 1.0 && to >= 1.0);
    double sum;
    if (same) {
        const double within = u + 0.5 * by;
        sum = heat_of_phase(node, within) * by;
    } else {
        const double most = node.drains ? std::numeric_limits<double>::max() : 1.0;
        sum = node.frozen * (std::min(to, 0.0) - std::min(u, 0.0)) +
              node.latent * (std::clamp(to, 0.0, most) - std::clamp(u, 0.0, most)) +
              node.thawed * (std::max(to, most) - std::max(u, most));
    }
    if (node.mass > 0.0) {
        const double before = temperature(i, u), after = temperature(i, to);
        sum += node.mass * polynomial_mean(node.polynomial, before, after) *
               (node.latent == 0.0 ? by : after - before);
    }
    return sum;
}

double NonlinearColumn::heat_of_phase(const NodeHeat& node, double u) {
    if (node.latent == 0.0) return node.thawed;
    if (u <= 0.0) return node.frozen;
    return node.drains || u < 1.0 ? node.latent : node.thawed;
}

double NonlinearColumn::heat_slope(std::size_t i, double u) const {
    const NodeHeat& node = node_[i];
    double slope = heat_of_phase(node, u);
    if (node.mass > 0.0) {
        slope +=
            node.mass * polynomial(node.polynomial, temperature(i, u)) * temperature_slope(i, u);
    }
    return slope;
}

double NonlinearColumn::up_to_kink(std::size_t i, double from, double to) const {
    constexpr double past = 1e-9;
    const NodeHeat& node = node_[i];
    if (node.latent == 0.0) return to;
    if (from < 0.0 && to > 0.0) return past;
    if (from > 0.0 && from <= 1.0 && to < 0.0) return -past;
    if (node.drains) return to;
    if (from >= 0.0 && from < 1.0 && to > 1.0) return 1.0 + past;
    if (from > 1.0 && to < 1.0) return 1.0 - past;
    return to;
}

double NonlinearColumn::drain(std::vector<double>& u) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < size(); ++i) {
        const NodeHeat& node = node_[i];
        if (!node.drains || node.latent * u[i] <= node.held) continue;
        sum += node.latent * u[i] - node.held;
        u[i] = node.held / node.latent;
    }
    return sum;
}

}  // namespace diurna
