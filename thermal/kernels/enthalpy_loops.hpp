#pragma once

#include <algorithm>
#include <cmath>

#include "thermal/kernels/enthalpy_faces.hpp"
#include "thermal/kernels/enthalpy_laws.hpp"
#include "thermal/kernels/enthalpy_map.hpp"
#include "thermal/kernels/enthalpy_sweeps.hpp"

// The loops of columns with freezing water, compiled once for each vector width (kernels_avx2.cpp,
// kernels_avx512.cpp); everything here is local to the unit that includes it.
//
// All laws are linear except for kinks where water begins or ends to melt, and the surface balance,
// which is solved separately: one sweep upward, the surface, one sweep downward is exact unless a
// node reaches a kink. There it halts, and the sweeps are repeated.

namespace diurna {

namespace {

/// Bounds of a lane's surface node.
struct Bracket {
    alignas(64) double low[W], high[W], done[W];
    alignas(64) double settled[W];  // [K] last correction, which is applied
};

/// One Newton step of all surface nodes within their brackets. Returns how many have not converged.
///
/// i  number of steps before this one: from 60 on the brackets are halved
double step_top(const EnthalpyStage& e, const NodeLaw& node, const double* under,
                const double* under_slope, int i, Bracket& b) {
    const double leads = i < 60 ? 1.0 : 0.0;
    const double *const begin = e.begin, *const target = e.target, *const tau = e.tau;
    const double* const flux_slope = e.slope;
    double *const by = e.by, *const flux = e.flux;
    double left = 0.0;
#pragma omp simd reduction(+ : left)
    for (std::size_t l = 0; l < W; ++l) {
        const double at = by[l], u = begin[l] + at, bend = bend_of(node, u);
        const double rate = 1.0 / tau[l];
        const double stored = (gain_of(node, begin[l], at) - target[l]) * rate;
        const double excess = flux[l] + under[l] - stored;
        const double low = excess > 0.0 ? at : b.low[l], high = excess > 0.0 ? b.high[l] : at;
        const double slope =
            heat_slope_of(node, u) * rate - (flux_slope[l] + under_slope[l]) * bend;
        const double newton = excess / slope;
        const double stop = halted(node, u, u + newton) - begin[l];
        double next = node.plain ? at + newton : stop;
        const double small = std::abs(newton) < b.settled[l] ? 1.0 : 0.0;
        const double inside = (next > low) & (next < high) ? leads : 0.0;
        next = inside + small > 0.0 ? next : 0.5 * (low + high);
        next = b.done[l] > 0.0 ? at : next;
        const double narrow = high - low < 1e-12 ? 1.0 : 0.0;
        const double done = small + narrow + b.done[l] > 0.0 ? 1.0 : 0.0;
        b.low[l] = low;
        b.high[l] = high;
        b.done[l] = done;
        by[l] = next;
        flux[l] += flux_slope[l] * bend * (next - at);
        left += 1.0 - done;
    }
    return left;
}

/// Change of the surface nodes, each from a separate decreasing equation.
void solve_top(const EnthalpySurface& s, const EnthalpyStage& e, const Eliminated& below) {
    constexpr int most = 120;
    const EnthalpyColumn& c = e.column;
    const NodeLaw node(c.node[0]);
    const bool alone = c.node.size() == 1;
    const EnthalpyLink down = alone ? EnthalpyLink{} : c.link[0];
    const double* const loses = below.loses + (alone ? 0 : W);
    alignas(64) double rest[W], t[W], under[W], under_slope[W];
    Bracket bracket;
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        rest[l] = potential_of(down, node.zero + theta_of(node, e.begin[l] + e.by[l]));
        bracket.low[l] = coldest_node - node.zero - e.begin[l];
        bracket.high[l] = hottest_node - node.zero - e.begin[l];
        bracket.done[l] = 0.0;
        // The error is of second order except where melting or freezing begins or ends.
        bracket.settled[l] = s.frost_heat[l] + s.water_heat[l] > 0.0 ? 1e-9 : 1e-6;
    }
    for (int i = 0; i < most; ++i) {
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            t[l] = node.zero + theta_of(node, e.begin[l] + e.by[l]);
        }
        // A skin over snow need not be exact while the ground is far from its result.
        const double skin_settled = i == 0 ? 1e-1 : i == 1 ? 1e-3 : 1e-8;
        into_ground(s, t, skin_settled, e.skin, e.flux, e.slope);
        if (alone) {
            from_below(s, c, t, e.below, e.below_slope);
            std::copy_n(e.below, W, under);
            std::copy_n(e.below_slope, W, under_slope);
        } else {
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) {
                const double pull = loses[l] * down.per_width;
                under[l] = below.flux[l] - pull * (potential_of(down, t[l]) - rest[l]);
                under_slope[l] = -pull * conductivity_of(down, t[l]);
            }
        }
        const double left = step_top(e, node, under, under_slope, i, bracket);
        if (s.cover && i < 2) {
            std::fill_n(bracket.done, W, 0.0);
        } else if (left == 0.0) {
            return;
        }
    }
}

/// Fluxes and slopes at both ends at the end of the stage; `left` gets the residual of the back's
/// balance [W m⁻²], whose film has a kink.
void take_down(const EnthalpySurface& s, const EnthalpyStage& e, const double* last_before,
               double* left) {
    const EnthalpyColumn& c = e.column;
    const std::size_t end = (c.node.size() - 1) * W, second = c.node.size() > 1 ? W : 0;
    const NodeLaw bottom(c.node.back()), top(c.node[0]), next(c.node[second > 0 ? 1 : 0]);
    const EnthalpyLink link = second > 0 ? c.link[0] : EnthalpyLink{};
    alignas(64) double t[W], flux[W], slope[W];
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        t[l] = bottom.zero + theta_of(bottom, e.begin[end + l] + e.by[end + l]);
    }
    from_below(s, c, t, flux, slope);
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        left[l] = std::abs(flux[l] - e.below[l] - e.below_slope[l] * (t[l] - last_before[l]));
        e.below[l] = flux[l];
        e.below_slope[l] = slope[l];
        const double u0 = e.begin[l] + e.by[l], u1 = e.begin[second + l] + e.by[second + l];
        const double stored = (gain_of(top, e.begin[l], e.by[l]) - e.target[l]) / e.tau[l];
        const double conducted =
            link.per_width * (potential_of(link, next.zero + theta_of(next, u1)) -
                              potential_of(link, top.zero + theta_of(top, u0)));
        e.taken[l] = stored - (second > 0 ? conducted : flux[l]);
    }
}

int solve_enthalpy(const EnthalpySurface& s, const EnthalpyStage& e) {
    constexpr int most_passes = 60;
    constexpr double settled = 1e-8;  // [W m⁻²] of a plate's back
    const EnthalpyColumn& c = e.column;
    const std::size_t size = c.node.size() * W;
    const NodeLaw top(c.node[0]), bottom(c.node.back());
    const EnthalpyLink down = c.node.size() == 1 ? EnthalpyLink{} : c.link[0];
    const bool back_bends = s.behind && c.node.size() > 1;
    Eliminated below{e.work, e.work + size, e.work + 2 * size, {}};
    alignas(64) double rest[W], last[W], bent[W], left[W];
    for (int passes = 1;; ++passes) {
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            rest[l] = potential_of(down, top.zero + theta_of(top, e.begin[l] + e.by[l]));
            last[l] = bottom.zero + theta_of(bottom, e.begin[size - W + l] + e.by[size - W + l]);
        }
        sweep_upward(s, e, below);
        solve_top(s, e, below);
        sweep_downward(e, below, rest, passes <= most_passes - 10, bent);
        take_down(s, e, last, left);
        double open = 0.0;
        for (std::size_t l = 0; l < W; ++l) {
            const bool number = left[l] < 1e9;
            const bool solved = number && bent[l] == 0.0 && (!back_bends || left[l] < settled);
            e.solved[l] = solved ? 1.0 : 0.0;
            open += number && !solved ? 1.0 : 0.0;
        }
        if (open == 0.0 || passes == most_passes) return passes;
    }
}

}  // namespace

}  // namespace diurna
