#include "thermal/nonlinear_column.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "materials/units.hpp"

namespace diurna {

namespace {

constexpr double melting_point = zero_celsius;
constexpr double heat_of_fusion = 3.337e5;         // [J kg⁻¹]
constexpr double coldest = 1.0, hottest = 5000.0;  // [K]

double polynomial(const HeatPolynomial& c, double t) {
    return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4])));
}

double polynomial_integral(const HeatPolynomial& c, double t) {
    return t * (c[0] + t * (c[1] / 2 + t * (c[2] / 3 + t * (c[3] / 4 + t * c[4] / 5))));
}

}  // namespace

NonlinearColumn::NonlinearColumn(std::span<const Layer> layers, const Bottom& bottom,
                                 double reference, const GridOptions& options) {
    // The nodes of the linear column; a layer's boundaries are nodes, so each link has one layer.
    const ColumnGrid grid = column_grid(layers, bottom, options);
    const std::size_t nodes = grid.size();
    const bool fixed = std::holds_alternative<FixedTemperature>(bottom);
    depth_ = grid.depth;
    node_.resize(nodes + (fixed ? 1 : 0));
    std::vector<double> bound = depth_;
    double bottom_depth = 0.0;
    for (const Layer& layer : layers) bottom_depth += layer.thickness;
    if (fixed) bound.push_back(bottom_depth);

    std::size_t l = 0;
    double layer_end = layers[0].thickness;
    for (std::size_t i = 0; i + 1 < bound.size(); ++i) {
        const double middle = 0.5 * (bound[i] + bound[i + 1]);
        while (middle > layer_end && l + 1 < layers.size()) layer_end += layers[++l].thickness;
        const Layer& layer = layers[l];
        const double width = bound[i + 1] - bound[i];
        Link link{.per_width = 1.0 / width,
                  .frozen = layer.conductivity,
                  .thawed = layer.conductivity,
                  .cubic = 0.0};
        NodeHeat half;
        const double mass = 0.5 * layer.density * width;
        half.thawed = half.frozen = mass * layer.heat_capacity;
        if (const auto* radiating = std::get_if<Radiating>(&layer.law)) {
            link.cubic = radiating->cubic;
            half.thawed = half.frozen = 0.0;
            half.mass = mass;
            half.polynomial = radiating->heat;
            linear_ = false;
        } else if (const auto* freezing = std::get_if<Freezing>(&layer.law)) {
            link.frozen = freezing->frozen_conductivity;
            half.frozen = mass * freezing->frozen_heat_capacity;
            half.latent = 0.5 * width * freezing->water * heat_of_fusion;
            linear_ = false;
        } else if (const auto* melting = std::get_if<Melting>(&layer.law)) {
            half.latent = mass * heat_of_fusion;
            half.drains = true;
            half.held = melting->held * half.latent;
            linear_ = false;
        }
        for (const std::size_t n : {i, i + 1}) {
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
        link_.push_back(link);
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
    for (NodeHeat& node : node_) node.zero = node.latent > 0.0 ? melting_point : reference;
    assert(link_.size() + 1 == node_.size());
}

NonlinearColumn::Potential NonlinearColumn::potential(const Link& link, double temperature) {
    const double theta = temperature - melting_point;
    if (link.cubic > 0.0) {
        const double cube = temperature * temperature * temperature;
        return {link.thawed * (theta + link.cubic * 0.25 * cube * temperature),
                link.thawed * (1.0 + link.cubic * cube)};
    }
    const double k = theta < 0.0 ? link.frozen : link.thawed;
    return {k * theta, k};
}

double NonlinearColumn::temperature(std::size_t i, double u) const {
    const NodeHeat& node = node_[i];
    if (node.latent == 0.0 || u <= 0.0) return node.zero + u;
    if (node.drains || u < 1.0) return melting_point;
    return melting_point + u - 1.0;
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

double NonlinearColumn::heat(std::size_t i, double u) const {
    const NodeHeat& node = node_[i];
    double sum;
    if (node.latent == 0.0) {
        sum = node.thawed * u;
    } else if (u <= 0.0) {
        sum = node.frozen * u;
    } else if (node.drains) {
        sum = node.latent * u;
    } else {
        sum = node.latent * std::min(u, 1.0) + node.thawed * std::max(0.0, u - 1.0);
    }
    if (node.mass > 0.0) {
        sum += node.mass * (polynomial_integral(node.polynomial, temperature(i, u)) -
                            polynomial_integral(node.polynomial, node.zero));
    }
    return sum;
}

double NonlinearColumn::heat_slope(std::size_t i, double u) const {
    const NodeHeat& node = node_[i];
    double slope;
    if (node.latent == 0.0) {
        slope = node.thawed;
    } else if (u <= 0.0) {
        slope = node.frozen;
    } else {
        slope = node.drains || u < 1.0 ? node.latent : node.thawed;
    }
    if (node.mass > 0.0) {
        slope +=
            node.mass * polynomial(node.polynomial, temperature(i, u)) * temperature_slope(i, u);
    }
    return slope;
}

double NonlinearColumn::total_heat(std::span<const double> u) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < size(); ++i) sum += heat(i, u[i]);
    return sum;
}

double NonlinearColumn::molten(std::span<const double> u) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < size(); ++i) {
        if (node_[i].latent > 0.0) {
            sum += node_[i].latent *
                   (node_[i].drains ? std::max(0.0, u[i]) : std::clamp(u[i], 0.0, 1.0));
        }
    }
    return sum;
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

BoundaryFlux NonlinearColumn::from_below(double temperature, const Boundary* back) const {
    if (back) return (*back)(temperature);
    if (below_is_link_) {
        const Potential here = potential(below_link_, temperature);
        const Potential there = potential(below_link_, below_temperature_);
        return {below_link_.per_width * (there.value - here.value),
                -below_link_.per_width * here.slope};
    }
    return {below_flux_ + below_conductance_ * (below_temperature_ - temperature),
            -below_conductance_};
}

bool NonlinearColumn::solve_stage(double tau, const std::vector<double>& target,
                                  const Boundary& top, const Boundary* back, std::vector<double>& u,
                                  int& iterations) const {
    constexpr int most_passes = 60;
    constexpr double settled = 1e-9;  // [K]
    const std::size_t n = size();
    static thread_local std::vector<double> offset, follow;
    offset.resize(std::max(offset.size(), n));
    follow.resize(offset.size());
    const bool once = linear_ && !back;
    for (int pass = 0; pass < most_passes; ++pass) {
        // Upward: what is left of the nodes below answers the link's potential above by
        // δu = offset + follow δΦ.
        double carried_flux = 0.0, carried_slope = 0.0;  // heat from below into node i; d/du
        for (std::size_t i = n - 1;; --i) {
            if (i == n - 1) {
                const BoundaryFlux below = from_below(temperature(i, u[i]), back);
                carried_flux = below.flux;
                carried_slope = below.slope * temperature_slope(i, u[i]);
            } else {
                const Link& link = link_[i];
                const double t_below = temperature(i + 1, u[i + 1]);
                const Potential low = potential(link, t_below);
                const Potential high = potential(link, temperature(i, u[i]));
                const double low_slope = low.slope * temperature_slope(i + 1, u[i + 1]);
                // Flux up the link for node i at rest, node i + 1 following.
                carried_flux =
                    link.per_width * (low.value + low_slope * offset[i + 1] - high.value);
                carried_slope = -link.per_width * (1.0 - low_slope * follow[i + 1]) * high.slope *
                                temperature_slope(i, u[i]);
            }
            if (i == 0) break;
            const Link& up = link_[i - 1];
            const Potential here = potential(up, temperature(i, u[i]));
            const Potential above = potential(up, temperature(i - 1, u[i - 1]));
            const double excess = (heat(i, u[i]) - target[i]) / tau - carried_flux -
                                  up.per_width * (above.value - here.value);
            const double slope = heat_slope(i, u[i]) / tau - carried_slope +
                                 up.per_width * here.slope * temperature_slope(i, u[i]);
            offset[i] = -excess / slope;
            follow[i] = up.per_width / slope;
        }
        // The surface: one monotone equation, whatever stands above.
        const double rest = u[0];
        const Link* down = n > 1 ? &link_[0] : nullptr;
        double answer = 0.0, rest_potential = 0.0;
        if (down) {
            const Potential low = potential(*down, temperature(1, u[1]));
            answer = down->per_width * (1.0 - low.slope * temperature_slope(1, u[1]) * follow[1]);
            rest_potential = potential(*down, temperature(0, rest)).value;
        }
        double low = coldest - node_[0].zero, high = hottest - node_[0].zero, at = rest;
        for (int i = 0; i < 200; ++i) {
            const double t = temperature(0, at), bend = temperature_slope(0, at);
            const BoundaryFlux above = top(t);
            double from_under = carried_flux, under_slope = 0.0;
            if (down) {
                const Potential here = potential(*down, t);
                from_under -= answer * (here.value - rest_potential);
                under_slope = -answer * here.slope * bend;
            } else {
                const BoundaryFlux below = from_below(t, back);
                from_under = below.flux;
                under_slope = below.slope * bend;
            }
            const double excess = above.flux + from_under - (heat(0, at) - target[0]) / tau;
            const double slope = heat_slope(0, at) / tau - above.slope * bend - under_slope;
            (excess > 0.0 ? low : high) = at;
            double next = at + excess / slope;
            if (std::abs(next - at) < 2e-12) {  // and what is left goes with its square
                at = next;
                break;
            }
            // Every kink is crossed by landing on it; what strays is halved.
            if (node_[0].latent > 0.0) {
                const double kink = at < 0.0 ? 0.0 : 1.0;
                if (at < kink && next > kink + 1e-9) next = kink + 1e-9;
                if (at > 1.0 && next < 1.0 - 1e-9 && !node_[0].drains) next = 1.0 - 1e-9;
                if (at > 0.0 && at <= 1.0 && next < -1e-9) next = -1e-9;
            }
            if (!(next > low && next < high) || i > 60) next = 0.5 * (low + high);
            ++iterations;
            at = next;
            if (high - low < 1e-12) break;
        }
        double worst = std::abs(at - rest);
        const double before = temperature(0, rest);
        u[0] = at;
        double rise =
            down ? potential(*down, temperature(0, at)).value - potential(*down, before).value
                 : 0.0;
        for (std::size_t i = 1; i < n; ++i) {
            double move = offset[i] + follow[i] * rise;
            const double old = u[i];
            if (node_[i].latent > 0.0 && pass < most_passes - 10) {
                const double next = old + move;
                if (old < 0.0 && next > 0.0) move = 1e-9 - old;
                if (old > 0.0 && old <= 1.0 && next < 0.0) move = -1e-9 - old;
                if (!node_[i].drains) {
                    if (old < 1.0 && old >= 0.0 && next > 1.0) move = 1.0 + 1e-9 - old;
                    if (old > 1.0 && next < 1.0) move = 1.0 - 1e-9 - old;
                }
            }
            worst = std::max(worst, std::abs(move));
            if (i + 1 < n) {
                // The next node was promised the linear answer of this one.
                rise = potential(link_[i], temperature(i, old)).slope * temperature_slope(i, old) *
                       move;
            }
            u[i] = std::clamp(old + move, coldest - node_[i].zero, hottest - node_[i].zero);
        }
        if (once || worst < settled) return true;
        if (!std::isfinite(worst)) return false;
    }
    return false;
}

void NonlinearColumn::carry(double tau, const std::vector<double>& u, double top_slope,
                            double bottom_slope, Eigen::MatrixXd& right) const {
    // Tridiagonal, from the bottom upward, every column of the right-hand side at once.
    const auto n = static_cast<Eigen::Index>(size());
    std::vector<double> follow(size());
    for (Eigen::Index i = n - 1; i >= 0; --i) {
        const auto j = static_cast<std::size_t>(i);
        const double t = temperature(j, u[j]), bend = temperature_slope(j, u[j]);
        double diagonal = heat_slope(j, u[j]) / tau;
        right.row(i) /= tau;
        if (i == n - 1) {
            diagonal -= bottom_slope * bend;
        } else {
            const Link& link = link_[j];
            const double low = potential(link, temperature(j + 1, u[j + 1])).slope *
                               temperature_slope(j + 1, u[j + 1]);
            diagonal += link.per_width * potential(link, t).slope * bend;
            diagonal -= link.per_width * low * follow[j + 1];
            right.row(i) += link.per_width * low * right.row(i + 1);
        }
        if (i == 0) {
            diagonal -= top_slope * bend;
        } else {
            const Link& up = link_[j - 1];
            diagonal += up.per_width * potential(up, t).slope * bend;
            const double above = potential(up, temperature(j - 1, u[j - 1])).slope *
                                 temperature_slope(j - 1, u[j - 1]);
            follow[j] = up.per_width * above / diagonal;
        }
        right.row(i) /= diagonal;
    }
    for (Eigen::Index i = 1; i < n; ++i) {
        right.row(i) += follow[static_cast<std::size_t>(i)] * right.row(i - 1);
    }
}

NonlinearColumn::Step NonlinearColumn::advance(
    double step, bool gentle, const std::array<const Boundary*, 2>& top,
    const std::array<const Boundary*, 2>& back, std::vector<double>& u, Eigen::MatrixXd* map,
    const std::array<std::vector<double>, 2>* source) const {
    const std::size_t n = size();
    static thread_local std::vector<double> begin, target;
    begin.resize(n);
    target.resize(n);
    for (std::size_t i = 0; i < n; ++i) begin[i] = target[i] = heat(i, u[i]);
    Eigen::MatrixXd start;
    if (map) {
        for (std::size_t i = 0; i < n; ++i) {
            map->row(static_cast<Eigen::Index>(i)) *= heat_slope(i, u[i]);
        }
        start = *map;
    }
    Step result;
    const double tau = gentle ? step : sdirk_gamma * step;
    constexpr double again = (1.0 - sdirk_gamma) / sdirk_gamma;
    for (int k = gentle ? 1 : 0; k < 2; ++k) {
        const auto stage = static_cast<std::size_t>(k);
        double released = 0.0;
        for (std::size_t i = 0; source && i < n; ++i) {
            target[i] += tau * (*source)[stage][i];
            released += (*source)[stage][i];
        }
        result.solved = solve_stage(tau, target, *top[stage], back[stage], u, result.iterations);
        if (!result.solved) return result;
        const BoundaryFlux above = (*top[stage])(temperature(0, u[0]));
        const BoundaryFlux below = from_below(temperature(n - 1, u[n - 1]), back[stage]);
        const double weight = gentle ? step : step * (k == 0 ? 1.0 - sdirk_gamma : sdirk_gamma);
        result.surface[stage] = temperature(0, u[0]);
        result.heat_in += weight * (above.flux + below.flux + released);
        result.through +=
            weight * (std::abs(above.flux) + std::abs(below.flux) + std::abs(released));
        if (map) carry(tau, u, above.slope, below.slope, *map);
        if (k == 1) break;
        for (std::size_t i = 0; i < n; ++i) {
            target[i] = begin[i] + again * (heat(i, u[i]) - begin[i]);
        }
        if (map) {
            for (std::size_t i = 0; i < n; ++i) {
                const auto row = static_cast<Eigen::Index>(i);
                map->row(row) =
                    start.row(row) + again * (heat_slope(i, u[i]) * map->row(row) - start.row(row));
            }
        }
    }
    return result;
}

}  // namespace diurna
