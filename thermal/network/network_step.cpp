#include "thermal/network/network_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double at_rest = 1e-10;   // [K] of a correction, where next to none does
constexpr double nearly = 1e-3;     // of the heat that flows: so near that Newton's step is right
constexpr double warmest = 5000.0;  // [K] no step of Newton's leads beyond

/// σ R (T² + T*²)(T + T*): what a kelvin between a face and its radiant mean carries.
double star_conductance(double radiant, double face, double star) {
    return stefan_boltzmann * radiant * (face * face + star * star) * (face + star);
}

}  // namespace

NetworkStepper::NetworkStepper(const HeatNetwork& network)
    : network_(network), system_(network), given_(system_) {
    const std::size_t facets = network.facet.size();
    for (std::vector<double>* of :
         {&loads_.outer, &loads_.inner, &faces_.outer, &faces_.outer_slope, &faces_.inner,
          &faces_.inner_slope, &outer_, &inner_, &to_star_}) {
        of->assign(facets, 0.0);
    }
    loads_.lump.assign(network.lump.size(), 0.0);
    loads_.fixed.assign(network.lump.size(), 0.0);
    flowing_.assign(given_.blocks(), 0.0);
    settle(zero_celsius);
}

void NetworkStepper::settle(double kelvin) {
    state.node.assign(system_.nodes(), kelvin);
    state.lump.assign(network_.lump.size(), kelvin);
    state.edge.assign(network_.edges, kelvin);
    begin();
}

void NetworkStepper::begin() { last_step_ = 0.0; }

void NetworkStepper::ends(std::vector<double>& outer, std::vector<double>& inner) const {
    for (std::size_t f = 0; f < network_.facet.size(); ++f) {
        outer[f] = state.node[system_.node_of(f)];
        inner[f] = state.node[system_.last_of(f)];
    }
}

namespace {

/// Heat that goes into nodes, and how much of it there is in all.
struct Flows {
    double sum = 0.0;  // [W]
    void into(double watts, double& to) {
        to += watts;
        sum += std::abs(watts);
    }
    void pass(double watts, double& from, double& to) {
        from -= watts;
        into(watts, to);
    }
};

}  // namespace

/// What the equations of a facet's nodes lack, and what it gives others; returns all that flows.
double NetworkStepper::facet_residual(std::size_t f, std::size_t block, double tau,
                                      const NetworkState& start) {
    Flows flows;
    const NetworkFacet& facet = network_.facet[f];
    const NetworkColumn& column = network_.column[facet.column];
    const ColumnGrid& grid = column.grid;
    const std::size_t at = system_.node_of(f), last = system_.last_of(f);
    const double area = facet.area;
    for (std::size_t j = at; j <= last; ++j) {
        const double store = grid.capacity[j - at] / tau;
        flows.into(-area * store * (state.node[j] - start.node[j]), missing_.node[j]);
        if (j == last) break;
        flows.pass(area * grid.conductance[j - at] * (state.node[j] - state.node[j + 1]),
                   missing_.node[j], missing_.node[j + 1]);
    }
    flows.into(facet.open * area * (faces_.outer[f] + loads_.outer[f]), missing_.node[at]);
    for (const HeatTouch& touch : system_.touches_of(f)) {
        double& there = given_.to_touched(std::size_t(&touch - network_.touch.data()));
        there = 0.0;
        flows.pass(touch.conductance * (state.node[at] - state.edge[touch.edge]), missing_.node[at],
                   there);
    }
    flows.into(area * (faces_.inner[f] + loads_.inner[f] + grid.below_flux +
                       grid.conductance.back() * (grid.below_temperature - state.node[last])),
               missing_.node[last]);
    for (int end = 0; end < 2; ++end) {
        if (facet.edge[end][0] == no_number || column.spread[end] == 0.0) continue;
        double& node = missing_.node[end == 0 ? at : last];
        const double here = state.node[end == 0 ? at : last];
        const SidewaysFlow& b = facet.sideways;
        double away[3];
        for (int s = 0; s < 3; ++s) away[s] = here - state.edge[facet.edge[end][s]];
        const double out[3]{b[0] * away[0] + b[1] * away[1] + b[2] * away[2],
                            b[1] * away[0] + b[3] * away[1] + b[4] * away[2],
                            b[2] * away[0] + b[4] * away[1] + b[5] * away[2]};
        for (int s = 0; s < 3; ++s) {
            double& there = given_.to_edge(f, end, s);
            there = 0.0;
            flows.pass(column.spread[end] * out[s], node, there);
        }
    }
    for (const auto b : {behind_air, behind_star, behind_touched}) {
        if (facet.lump[b] == no_number) continue;
        const double there = state.lump[facet.lump[b]];
        double film = b == behind_air ? facet.film : facet.contact;
        if (b == behind_star) {
            film = to_star_[f] = star_conductance(facet.radiant, state.node[last], there);
        }
        flows.pass(area * film * (state.node[last] - there), missing_.node[last],
                   given_.to_lump(block, facet.lump[b]));
    }
    return flows.sum;
}

/// What every equation lacks at the present state; returns its share of all heat that flows.
double NetworkStepper::residual(double tau, const NetworkState& start) {
    missing_.node.assign(state.node.size(), 0.0);
    missing_.edge.assign(state.edge.size(), 0.0);
    missing_.lump.assign(state.lump.size(), 0.0);
    std::fill(flowing_.begin(), flowing_.end(), 0.0);
    given_.of_facets([&](std::size_t block, std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            flowing_[block] += facet_residual(f, block, tau, start);
        }
    });
    given_.add_to(missing_.edge.data(), missing_.lump.data());
    double flowing = 0.0;
    Flows flows;
    for (const double of_block : flowing_) flowing += of_block;
    for (const HeatLink& link : network_.link) {
        flows.pass(link.conductance * (state.lump[link.a] - state.lump[link.b]),
                   missing_.lump[link.a], missing_.lump[link.b]);
    }
    for (const HeatStream& stream : network_.stream) {
        flows.into(stream.conductance * (state.lump[stream.from] - state.lump[stream.to]),
                   missing_.lump[stream.to]);
    }
    double missing = 0.0;
    for (std::size_t k = 0; k < state.lump.size(); ++k) {
        const double store = network_.lump[k].capacity / tau;
        flows.into(loads_.lump[k] - store * (state.lump[k] - start.lump[k]), missing_.lump[k]);
        if (network_.lump[k].fixed) missing_.lump[k] = 0.0;
        missing += std::abs(missing_.lump[k]);
    }
    const auto sum = [](const std::vector<double>& of) {
        double part[4]{};
        for (std::size_t k = 0; k < of.size(); ++k) part[k % 4] += std::abs(of[k]);
        return (part[0] + part[1]) + (part[2] + part[3]);
    };
    missing += sum(missing_.node) + sum(missing_.edge);
    flowing += flows.sum;
    return flowing > 0.0 ? missing / flowing : 0.0;
}

void NetworkStepper::stage(double tau, double share, const NetworkForcing& forcing,
                           const NetworkState& start) {
    constexpr int most_newton = 40;
    std::fill(loads_.outer.begin(), loads_.outer.end(), 0.0);
    std::fill(loads_.inner.begin(), loads_.inner.end(), 0.0);
    std::fill(loads_.lump.begin(), loads_.lump.end(), 0.0);
    if (forcing.loads) forcing.loads(share, loads_);
    for (std::size_t k = 0; k < state.lump.size(); ++k) {
        if (network_.lump[k].fixed) state.lump[k] = loads_.fixed[k];
    }
    ++count.stages;
    double before = 1e300, left = 1e300, reach = 1.0;
    for (int i = 0;; ++i) {
        ends(outer_, inner_);
        if (forcing.faces) forcing.faces(share, outer_, inner_, faces_);
        if (forcing.jets) forcing.jets(share, outer_, inner_, state.lump, faces_);
        left = residual(tau, start);
        if (!(left > closed)) break;
        if (i == most_newton) {
            ++count.limited;
            break;
        }
        // A film bends where its surface is as warm as the air: full steps may swing about it.
        if (left > 0.5 * before && i > 3) reach = std::max(0.25, 0.7 * reach);
        before = left;
        system_.factorise(tau, {faces_.outer_slope, faces_.inner_slope, to_star_});
        const double linear_error = std::clamp(0.2 * closed / left, 1e-4, 0.1);
        count.linear += system_.solve(missing_, linear_error);
        ++count.newton;
        double most = 0.0;
        const auto move = [&](std::vector<double>& of, const std::vector<double>& by) {
            for (std::size_t k = 0; k < of.size(); ++k) {
                const double next = of[k] + reach * by[k];
                of[k] = std::clamp(next, 0.5 * of[k], std::min(2.0 * of[k], warmest));
                most = std::max(most, std::abs(by[k]));
            }
        };
        move(state.node, missing_.node);
        move(state.edge, missing_.edge);
        move(state.lump, missing_.lump);
        if (most < at_rest) {
            left = 0.0;  // a share of next to nothing reports nothing
            break;
        }
        if (!confirmed && left < nearly && reach == 1.0 && 2.0 * linear_error * left <= closed) {
            left = closed;
            break;
        }
    }
    const auto beyond = [](double kelvin) { return !(kelvin < 0.999 * warmest); };
    if (std::any_of(state.node.begin(), state.node.end(), beyond) ||
        std::any_of(state.lump.begin(), state.lump.end(), beyond)) {
        ++count.limited;
    }
    count.worst_closure = std::max(count.worst_closure, left);
}

/// Sets out a stage from where the way from `since` leads, for Newton's sake.
void NetworkStepper::guess(const NetworkState& since, double onward) {
    const auto go_on = [&](std::vector<double>& now, const std::vector<double>& then) {
        for (std::size_t k = 0; k < now.size(); ++k) {
            // A jump leads nowhere.
            const double next = now[k] + onward * (now[k] - then[k]);
            now[k] = std::clamp(next, 0.9 * now[k], 1.1 * now[k]);
        }
    };
    go_on(state.node, since.node);
    go_on(state.edge, since.edge);
    go_on(state.lump, since.lump);
}

void NetworkStepper::guessed_stage(double tau, double share, const NetworkForcing& forcing,
                                   const NetworkState& start) {
    if (course == nullptr) {
        stage(tau, share, forcing, start);
        return;
    }
    const int limited = count.limited;
    guess_ = state;
    course->correct(state);
    stage(tau, share, forcing, start);
    if (count.limited > limited) {
        course->discard();
    } else {
        course->store(guess_, state);
    }
}

void NetworkStepper::advance(double step, const NetworkForcing& forcing) {
    const NetworkState start = state;
    const double tau = sdirk_gamma * step;
    if (last_step_ > 0.0) guess(before_, sdirk_gamma * step / last_step_);
    guessed_stage(tau, stage_share[0], forcing, start);
    NetworkState onward = start;
    const auto go_on = [](const std::vector<double>& now, std::vector<double>& of) {
        for (std::size_t k = 0; k < of.size(); ++k) of[k] += stage_onward * (now[k] - of[k]);
    };
    go_on(state.node, onward.node);
    go_on(state.lump, onward.lump);
    guess(start, 1.0 / sdirk_gamma - 1.0);
    guessed_stage(tau, stage_share[1], forcing, onward);
    before_ = start;
    last_step_ = step;
}

}  // namespace diurna
