#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/base/units.hpp"
#include "thermal/column/nonlinear_column.hpp"

namespace diurna {

namespace {

constexpr double coldest = 1.0, hottest = 5000.0;  // [K]

/// a + (b + c), and what the sum leaves over.
double sum_of(double a, double b, double c, double& rest) {
    const double add = b + c, sum = a + add, back = sum - a;
    rest = (a - (sum - back)) + (add - back);
    return sum;
}

bool all_finite(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

/// What is left of the nodes below: they answer the potential of the link above them by
/// δu = offset + follow δΦ, and give the node above all but `loses` of what comes down to them.
struct NonlinearColumn::Below {
    std::vector<double> offset, follow, loses;
    double flux = 0.0;  // [W m⁻²] up into the surface node while it rests
};

double NonlinearColumn::conducted(const Link& link, double high, double low, double apart) {
    if (link.cubic > 0.0) {
        const double fourth = (low + high) * (low * low + high * high);
        return link.per_width * link.thawed * apart * (1.0 + 0.25 * link.cubic * fourth);
    }
    if (link.frozen == link.thawed || (high < zero_celsius) == (low < zero_celsius)) {
        return link.per_width * potential(link, low).slope * apart;
    }
    return link.per_width * (potential(link, low).value - potential(link, high).value);
}

double NonlinearColumn::conducted(const Way& way, std::size_t i) const {
    const double apart = way.apart[i] + (warmed(i + 1, way.begin[i + 1], way.by[i + 1]) -
                                         warmed(i, way.begin[i], way.by[i]));
    return conducted(link_[i], temperature(i, way.u(i)), temperature(i + 1, way.u(i + 1)), apart);
}

BoundaryFlux NonlinearColumn::from_below(const Way& way, double by, const Boundary* back) const {
    const std::size_t last = size() - 1;
    const double here = temperature(last, way.begin[last] + by);
    if (back) return (*back)(here);
    const double apart = way.apart[last] - warmed(last, way.begin[last], by);
    if (!below_is_link_) return {below_flux_ + below_conductance_ * apart, -below_conductance_};
    return {conducted(below_link_, here, below_temperature_, apart),
            -below_link_.per_width * potential(below_link_, here).slope};
}

/// How far the surface node goes: one monotone equation, whatever stands above. No number where it
/// has no solution from `coldest` to `hottest`.
double NonlinearColumn::solve_surface_node(const Stage& stage, const Below& below, const Way& way,
                                           int& iterations) const {
    constexpr double rounding = 1e-15, settled = 1e-13;  // of the terms' magnitudes; [K]
    const double tau = stage.tau, target = stage.target[0];
    const NodeHeat& node = node_[0];
    const double begin = way.begin[0], rest = way.by[0];
    const Link* down = size() > 1 ? &link_[0] : nullptr;
    const double resting = temperature(0, begin + rest), warmed_rest = warmed(0, begin, rest);
    const double coldest_by = coldest - node.zero - begin;
    const double hottest_by = hottest - node.zero - begin;
    double low = coldest_by, high = hottest_by, at = rest;
    for (int i = 0; i < 200; ++i) {
        const double u = begin + at, t = temperature(0, u), bend = temperature_slope(0, u);
        const BoundaryFlux above = stage.top(t);
        double from_under, under_slope;
        if (down) {
            const double rise = warmed(0, begin, at) - warmed_rest;
            from_under = below.flux - below.loses[1] * conducted(*down, resting, t, rise);
            under_slope = -below.loses[1] * down->per_width * potential(*down, t).slope * bend;
        } else {
            const BoundaryFlux bottom = from_below(way, at, stage.back);
            from_under = bottom.flux;
            under_slope = bottom.slope * bend;
        }
        const double stored = (gain(0, begin, at) - target) / tau;
        const double excess = above.flux + from_under - stored;
        if (!std::isfinite(excess)) return excess;  // there is no such way
        const double terms = std::abs(above.flux) + std::abs(from_under) + std::abs(stored);
        if (std::abs(excess) <= rounding * terms) break;
        const double slope = heat_slope(0, u) / tau - above.slope * bend - under_slope;
        (excess > 0.0 ? low : high) = at;
        double next = at + excess / slope;
        if (std::abs(next - at) < settled) {  // and what is left goes with its square
            at = next;
            break;
        }
        // Every kink is crossed by landing on it; what outliers is halved.
        if (node.latent > 0.0) next = up_to_kink(0, u, begin + next) - begin;
        if (!(next > low && next < high) || i > 60) next = 0.5 * (low + high);
        ++iterations;
        at = next;
        if (high - low < 1e-12) {
            // At an end of all that is looked at, nothing is in balance.
            const bool beyond = at - coldest_by < 1e-9 || hottest_by - at < 1e-9;
            return beyond ? std::numeric_limits<double>::quiet_NaN() : at;
        }
    }
    return at;
}

/// From the bottom node up to the surface's, each linearised where it is.
void NonlinearColumn::eliminate_upward(const Stage& stage, const Way& way, Below& below) const {
    const double tau = stage.tau;
    const std::size_t n = size();
    double slope_below = 0.0;  // d/du of the heat from below into node i, negated
    for (std::size_t i = n - 1;; --i) {
        const double u = way.u(i), t = temperature(i, u), bend = temperature_slope(i, u);
        if (i == n - 1) {
            const BoundaryFlux bottom = from_below(way, way.by[i], stage.back);
            below.flux = bottom.flux;
            slope_below = -bottom.slope * bend;
        } else {
            const Link& link = link_[i];
            const double low_slope = potential(link, temperature(i + 1, way.u(i + 1))).slope *
                                     temperature_slope(i + 1, way.u(i + 1));
            // Flux up the link for node i at rest, node i + 1 following.
            below.flux = conducted(way, i) + link.per_width * low_slope * below.offset[i + 1];
            slope_below = link.per_width * below.loses[i + 1] * potential(link, t).slope * bend;
        }
        if (i == 0) return;
        const Link& up = link_[i - 1];
        const double excess = (gain(i, way.begin[i], way.by[i]) - stage.target[i]) / tau -
                              below.flux + conducted(way, i - 1);
        // Without the difference 1 − follow, which has no digits left where links are stiff.
        const double own = heat_slope(i, u) / tau + slope_below;
        const double slope = own + up.per_width * potential(up, t).slope * bend;
        below.offset[i] = -excess / slope;
        below.follow[i] = up.per_width / slope;
        below.loses[i] = own / slope;
    }
}

/// The surface node has gone on from `surface_rest`; the others follow. Returns the largest move of
/// any node. halting: water halts where it begins or ends to melt.
double NonlinearColumn::follow_downward(const Below& below, double surface_rest, bool halting,
                                        Way& way) const {
    double worst = std::abs(way.by[0] - surface_rest);
    double rise = 0.0;
    if (size() > 1) {
        const Link& down = link_[0];
        rise =
            conducted(down, temperature(0, way.begin[0] + surface_rest), temperature(0, way.u(0)),
                      warmed(0, way.begin[0], way.by[0]) - warmed(0, way.begin[0], surface_rest)) /
            down.per_width;
    }
    for (std::size_t i = 1; i < size(); ++i) {
        const double old = way.u(i);
        double move = below.offset[i] + below.follow[i] * rise;
        if (node_[i].latent > 0.0 && halting) move = up_to_kink(i, old, old + move) - old;
        worst = std::max(worst, std::abs(move));
        if (i + 1 < size()) {
            // The next node was promised the linear answer of this one.
            rise =
                potential(link_[i], temperature(i, old)).slope * temperature_slope(i, old) * move;
        }
        const double zero = node_[i].zero + way.begin[i];
        way.by[i] = std::clamp(way.by[i] + move, coldest - zero, hottest - zero);
    }
    return worst;
}

bool NonlinearColumn::solve_stage(const Stage& stage, Way& way, int& iterations) const {
    constexpr int most_passes = 60;
    constexpr double settled = 1e-9;  // [K]
    static thread_local Below below;
    for (std::vector<double>* part : {&below.offset, &below.follow, &below.loses}) {
        part->resize(std::max(part->size(), size()));
    }
    const bool once = linear_ && !stage.back;
    for (int pass = 0; pass < most_passes; ++pass) {
        eliminate_upward(stage, way, below);
        const double rest = way.by[0];
        way.by[0] = solve_surface_node(stage, below, way, iterations);
        const double worst = follow_downward(below, rest, pass < most_passes - 10, way);
        if (!all_finite(way.by)) return false;
        if (once || worst < settled) return true;
    }
    return false;
}

void NonlinearColumn::carry(const Stage& stage, const std::vector<double>& u, double top_slope,
                            double bottom_slope, Eigen::MatrixXd& right) const {
    // Tridiagonal, from the bottom upward, every column of the right-hand side at once.
    const auto n = static_cast<Eigen::Index>(size());
    std::vector<double> follow(size());
    for (Eigen::Index i = n - 1; i >= 0; --i) {
        const auto j = static_cast<std::size_t>(i);
        const double t = temperature(j, u[j]), bend = temperature_slope(j, u[j]);
        double diagonal = heat_slope(j, u[j]) / stage.tau;
        right.row(i) /= stage.tau;
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

/// The state a step sets out from, and how far its neighbours are apart.
void NonlinearColumn::set_out(const std::vector<double>& u, const std::vector<double>* rest,
                              Way& way) const {
    const std::size_t n = size();
    way.begin = u;
    way.by.assign(n, 0.0);
    way.apart.resize(n);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        way.apart[i] = (above_zero(i + 1, u[i + 1]) - above_zero(i, u[i])) +
                       (node_[i + 1].zero - node_[i].zero);
        if (rest) {
            way.apart[i] += temperature_slope(i + 1, u[i + 1]) * (*rest)[i + 1] -
                            temperature_slope(i, u[i]) * (*rest)[i];
        }
    }
    way.apart[n - 1] = (below_temperature_ - node_[n - 1].zero) - above_zero(n - 1, u[n - 1]);
}

NonlinearColumn::Step NonlinearColumn::advance(const StepForcing& forcing, std::vector<double>& u,
                                               Eigen::MatrixXd* map,
                                               std::vector<double>* rest) const {
    const std::size_t n = size();
    const double duration = forcing.duration;
    const double tau = forcing.gentle ? duration : sdirk_gamma * duration;
    static thread_local Way way;
    static thread_local std::vector<double> target;
    set_out(u, rest, way);
    target.assign(n, 0.0);
    Eigen::MatrixXd start;
    if (map) {
        for (std::size_t i = 0; i < n; ++i) {
            map->row(static_cast<Eigen::Index>(i)) *= heat_slope(i, u[i]);
        }
        start = *map;
    }
    Step result;
    for (std::size_t k = forcing.gentle ? 1 : 0; k < 2; ++k) {
        double released = 0.0;
        for (std::size_t i = 0; forcing.source[k] && i < n; ++i) {
            target[i] += tau * (*forcing.source[k])[i];
            released += (*forcing.source[k])[i];
        }
        const Stage stage{tau, target, *forcing.top[k], forcing.back[k]};
        result.solved = solve_stage(stage, way, result.iterations);
        if (!result.solved) return result;
        for (std::size_t i = 0; i < n; ++i) u[i] = way.u(i);
        const BoundaryFlux above = stage.top(temperature(0, u[0]));
        const BoundaryFlux below = from_below(way, way.by[n - 1], stage.back);
        const double weight = forcing.gentle ? duration : duration * stage_weight[k];
        result.surface[k] = temperature(0, u[0]);
        result.heat_in += weight * (above.flux + below.flux + released);
        result.through +=
            weight * (std::abs(above.flux) + std::abs(below.flux) + std::abs(released));
        if (map) carry(stage, u, above.slope, below.slope, *map);
        if (k == 1) {
            const double up = n > 1 ? conducted(way, 0) : below.flux;
            result.taken = (gain(0, way.begin[0], way.by[0]) - target[0]) / tau - up;
            break;
        }
        for (std::size_t i = 0; i < n; ++i)
            target[i] = stage_onward * gain(i, way.begin[i], way.by[i]);
        if (map) {
            for (std::size_t i = 0; i < n; ++i) {
                const auto row = static_cast<Eigen::Index>(i);
                map->row(row) =
                    start.row(row) +
                    stage_onward * (heat_slope(i, u[i]) * map->row(row) - start.row(row));
            }
        }
    }
    if (rest) {
        for (std::size_t i = 0; i < n; ++i) {
            u[i] = sum_of(way.begin[i], way.by[i], (*rest)[i], (*rest)[i]);
        }
    }
    return result;
}

}  // namespace diurna
