#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "materials/base/giving_up.hpp"
#include "thermal/point/point_facet.hpp"

namespace diurna {

namespace {

constexpr double shortest_step = 1e-7;  // [s]
constexpr double unsolved = 1e9;        // [K] counts as a step's error
constexpr double least_flux = 1e-3;     // [W m⁻²] that a balance is measured against

// What a facet may try before somebody must be reported: ten times and more what cases at the edges
// of all ranges need that come to an end (tests/thermal/patience_test.cpp).
constexpr double tries_at_all = 20000.0;
constexpr double tries_a_span = 200.0, tries_a_sample = 2000.0, tries_a_longest_step = 20.0;

}  // namespace

void PointFacet::take(const State& state) {
    u = state.u;
    rest_ = state.rest;
    standing = state.standing;
    water = state.water;
    rates_ = state.rates;
    snow_albedo_ = state.snow_albedo;
}

void PointFacet::count_closure(const Taken& taken, const State& before, const State& after) {
    double gained = 0.0, moved = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double by = (after.u[i] - before.u[i]) + (after.rest[i] - before.rest[i]);
        const double gain = column.gain(i, before.u[i], by);
        gained += gain;
        moved += std::abs(gain);
    }
    const SurfaceTerms at = surface_terms(taken.last, taken.step.surface[1]);
    ending_ = {at, taken.step.taken};
    const HeatBalance& b = at.balance;
    const double gross = least_flux + std::abs(b.absorbed_solar) + std::abs(b.longwave_in) +
                         std::abs(b.longwave_out) + std::abs(b.sensible) + std::abs(b.latent) +
                         std::abs(b.internal) + std::abs(at.frost_melt);
    const double scale = taken.step.through + taken.duration * gross + moved;
    count.worst_closure =
        std::max(count.worst_closure, std::abs(gained - taken.step.heat_in) / scale);
}

/// As long as the last error allows; to the limit, or half way there where that is not far.
double PointFacet::step_within(double limit) const {
    const double step = std::max(shortest_step, std::min(next_step_, setup_.longest_step));
    if (step >= 0.999 * limit) return limit;
    return step > 0.5 * limit ? 0.5 * limit : step;
}

/// Once over the whole step and twice over its halves.
void PointFacet::try_step(Instant from, double at, double step, bool gentle, const State& begin,
                          Trial& trial) const {
    trial.error = unsolved;
    trial.whole = trial.end = begin;
    if (!half_step(from, at, step, gentle, trial.whole, nullptr).step.solved) return;
    trial.first = half_step(from, at, 0.5 * step, gentle, trial.end, nullptr);
    trial.middle = trial.end;
    if (!trial.first.step.solved) return;
    trial.second = half_step(from, at + 0.5 * step, 0.5 * step, gentle, trial.end, nullptr);
    if (!trial.second.step.solved) return;
    trial.error = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        trial.error = std::max(trial.error, std::abs(column.temperature(i, trial.end.u[i]) -
                                                     column.temperature(i, trial.whole.u[i])));
    }
    // Wet or dry, a surface is some kelvin warmer or colder.
    constexpr double wet_matters = 15.0;  // [K] times three, as errors add up
    if (capacity_.any()) {
        trial.error =
            std::max(trial.error, wet_matters * apart(trial.end.standing, trial.whole.standing) /
                                      capacity_.water_mm);
    }
    trial.error /= 3.0;
}

void PointFacet::give_up(Instant when, double step, double error) const {
    throw std::runtime_error(fmt::format(
        "the heat balance makes no progress at {}: {} steps tried, the last of {:.1g} s {}",
        format_instant(when), tried_, step,
        error < unsolved ? fmt::format("with an error of {:.1g} K", error) : "without a solution"));
}

double PointFacet::advance(Instant from, Instant to, std::vector<double>* steps,
                           Eigen::MatrixXd* map) {
    const double span = seconds_between(from, to);
    auto knot = std::upper_bound(setup_.knot.begin(), setup_.knot.end(), from);
    double done = 0.0, melted = 0.0;
    bool stuck = false;  // the shortest step was not good enough
    State begin = state();
    Trial trial;
    granted_ += tries_a_span + tries_a_longest_step * span / setup_.longest_step;
    while (span - done > 1e-9) {
        give_up_if_asked();
        while (knot != setup_.knot.end() && seconds_between(from, *knot) <= done + 1e-9) {
            ++knot;
            granted_ += tries_a_sample;
        }
        double limit = span - done;  // to the next sample of the weather
        if (knot != setup_.knot.end()) {
            limit = std::min(limit, seconds_between(from, *knot) - done);
        }
        const double step = step_within(limit);
        const bool last_resort = stuck;
        try_step(from, done, step, last_resort, begin, trial);
        const double error = trial.error;
        if (double(++tried_) > tries_at_all + granted_) give_up(later(from, done), step, error);
        const double growth = error > 0.0 ? 0.9 * std::cbrt(setup_.tolerance / error) : 4.0;
        if (error > setup_.tolerance && !last_resort) {
            ++count.rejected;
            stuck = step <= shortest_step;
            next_step_ = step * std::clamp(growth, 0.1, 0.7);
            continue;
        }
        if (last_resort) ++count.limited;
        stuck = false;
        if (error < unsolved) {
            count_closure(trial.first, begin, trial.middle);
            count_closure(trial.second, trial.middle, trial.end);
            if (map) {
                // Over again with the map, now that the step is known to stand.
                half_step(from, done, 0.5 * step, last_resort, begin, map);
                half_step(from, done + 0.5 * step, 0.5 * step, last_resort, begin, map);
            }
            melted += trial.first.melted + trial.second.melted + column.drain(trial.end.u);
            std::swap(begin, trial.end);
        }
        if (steps) steps->push_back(step);
        ++count.steps;
        done += step;
        const double grown = step * std::clamp(growth, 0.2, 4.0);
        // A step cut short by a sample says little of how long the next may be.
        next_step_ = std::max(grown, step == limit ? std::min(next_step_, 10.0 * grown) : 0.0);
        next_step_ = std::clamp(next_step_, shortest_step, setup_.longest_step);
    }
    take(begin);
    return melted;
}

void PointFacet::repeat(Instant from, const std::vector<double>& steps, Eigen::MatrixXd& map) {
    double done = 0.0;
    for (const double step : steps) {
        for (int half = 0; half < 2; ++half) {
            State next = state();
            const Taken taken =
                half_step(from, done + 0.5 * step * half, 0.5 * step, false, next, &map);
            if (taken.step.solved) take(next);
        }
        column.drain(u);
        done += step;
    }
}

void PointFacet::march(Instant from, Instant to, bool restart, Eigen::MatrixXd* map) {
    constexpr double first = 10.0, growth = 3.0;  // [s]
    if (restart) next_march_ = first;
    const double span = seconds_between(from, to);
    for (double done = 0.0; done < span - 1e-6;) {
        give_up_if_asked();
        double step = std::min(next_march_, setup_.longest_step);
        if (span - done < 1.5 * step) step = span - done;
        march_step(from, done, step, 0, map);
        done += step;
        next_march_ = std::min(growth * step, setup_.longest_step);
    }
}

void PointFacet::march_step(Instant from, double at, double step, int depth, Eigen::MatrixXd* map) {
    constexpr int deepest = 10;
    const State before = state();
    State after = before;
    Eigen::MatrixXd given;
    if (map) given = *map;
    const bool gentle = depth == deepest;
    const Taken taken = half_step(from, at, step, gentle, after, map);
    ++count.steps;
    if (gentle) ++count.limited;
    if (taken.step.solved) {
        count_closure(taken, before, after);
        column.drain(after.u);
        take(after);
        return;
    }
    if (map) *map = given;
    if (gentle) {
        if (count.unsolved++ == 0) count.first_unsolved = later(from, at);
        return;
    }
    march_step(from, at, 0.5 * step, depth + 1, map);
    march_step(from, at + 0.5 * step, 0.5 * step, depth + 1, map);
}

double PointFacet::change_since(const std::vector<double>& start) const {
    double change = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) change = std::max(change, std::abs(u[i] - start[i]));
    return change;
}

/// What no start explains: a node that lies at the melting point all day freezes or melts by the
/// same each day, whatever it begins with. Goes on so many days at once that the node which does so
/// fastest is through.
Eigen::VectorXd PointFacet::until_melted(const std::vector<double>& start,
                                         const Eigen::VectorXd& drift) const {
    double fastest = 1e-5, days = 0.0;  // of a node's water a day
    for (std::size_t i = 0; i < start.size(); ++i) {
        const double by = drift[Eigen::Index(i)], from = start[i];
        if (!column.melts(i) || from < 0.0 || from > 1.0 || std::abs(by) < fastest) continue;
        fastest = std::abs(by);
        days = (by > 0.0 ? 1.0 - from : from) / fastest + 0.01;
    }
    return days * drift;
}

double PointFacet::close_period(const std::vector<double>& start, const Eigen::MatrixXd& map) {
    const auto n = static_cast<Eigen::Index>(u.size());
    Eigen::VectorXd change(n);
    for (Eigen::Index i = 0; i < n; ++i) change[i] = u[std::size_t(i)] - start[std::size_t(i)];
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> period;
    period.setThreshold(1e-9);  // a column that loses nothing keeps its mean
    period.compute(Eigen::MatrixXd::Identity(n, n) - map);
    // Where water freezes the map bends, and a whole step of Newton's may lead astray.
    Eigen::VectorXd move = period.solve(change);
    move += until_melted(start, change - move + map * move);
    constexpr double farthest = 20.0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const double from = start[std::size_t(i)];
        const double most = column.linear() ? 1e4 : farthest;
        const double to = from + std::clamp(move[i], -most, most);
        u[std::size_t(i)] = column.up_to_kink(std::size_t(i), from, to);
    }
    std::fill(rest_.begin(), rest_.end(), 0.0);
    const double far = move.cwiseAbs().maxCoeff();
    keep_in_bounds();
    return far;
}

void PointFacet::go_on_from(const PointFacet& other) {
    const double age = snow_albedo_;
    take(other.state());
    snow_albedo_ = age;
    next_step_ = other.next_step_;
}

void PointFacet::keep_in_bounds() {
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double t = column.temperature(i, u[i]);
        if (t < 1.0 || t > 5000.0) u[i] = column.state_of(i, std::clamp(t, 1.0, 5000.0));
    }
    column.drain(u);
}

}  // namespace diurna
