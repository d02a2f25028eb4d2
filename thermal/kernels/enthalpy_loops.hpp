#pragma once

#include <algorithm>
#include <cmath>

#include "thermal/kernels/enthalpy_faces.hpp"
#include "thermal/kernels/enthalpy_laws.hpp"

// The loops of columns whose water freezes, compiled once for each width of vectors
// (kernels_avx2.cpp, kernels_avx512.cpp); everything here belongs to the unit that includes it.
//
// All laws are straight but for bends where water begins or ends to melt, and the surface's
// balance, which is solved by itself: one sweep upward, the surface, one sweep downward is exact
// unless a node has come to a bend. There it halts, and the sweeps are made again.

namespace diurna {

namespace {

/// What is left of the nodes below: see NonlinearColumn::Below.
struct Eliminated {
    double *offset, *follow, *loses;  // [node][lane]
    alignas(64) double flux[W];       // up into the surface node while it rests
};

void sweep_upward(const EnthalpySurface& s, const EnthalpyStage& e, Eliminated& below) {
    const EnthalpyColumn& c = e.column;
    const std::size_t n = c.node.size();
    alignas(64) double slope_below[W], t[W], t_under[W], bend_under[W];
    for (std::size_t i = n - 1;; --i) {
        const EnthalpyNode& node = c.node[i];
        const double *begin = e.begin + i * W, *by = e.by + i * W;
        for (std::size_t l = 0; l < W; ++l) t[l] = node.zero + theta_of(node, begin[l] + by[l]);
        if (i == n - 1) {
            from_below(s, c, t, e.below, e.below_slope);
            for (std::size_t l = 0; l < W; ++l) {
                below.flux[l] = e.below[l];
                slope_below[l] = -e.below_slope[l] * bend_of(node, begin[l] + by[l]);
            }
        } else {
            const EnthalpyLink& link = c.link[i];
            const double *offset = below.offset + (i + 1) * W, *loses = below.loses + (i + 1) * W;
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) {
                const double low = conductivity_of(link, t_under[l]) * bend_under[l];
                const double flux = potential_of(link, t_under[l]) - potential_of(link, t[l]);
                below.flux[l] = link.per_width * (flux + low * offset[l]);
                slope_below[l] = link.per_width * loses[l] * conductivity_of(link, t[l]) *
                                 bend_of(node, begin[l] + by[l]);
            }
        }
        if (i == 0) return;
        const EnthalpyLink& up = c.link[i - 1];
        const EnthalpyNode& over = c.node[i - 1];
        const double *over_begin = begin - W, *over_by = by - W, *target = e.target + i * W;
        double *offset = below.offset + i * W, *follow = below.follow + i * W,
               *loses = below.loses + i * W;
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            const double u = begin[l] + by[l];
            const double above = over.zero + theta_of(over, over_begin[l] + over_by[l]);
            const double conducted =
                up.per_width * (potential_of(up, t[l]) - potential_of(up, above));
            const double excess =
                (gain_of(node, begin[l], by[l]) - target[l]) / e.tau - below.flux[l] + conducted;
            const double own = heat_slope_of(node, u) / e.tau + slope_below[l];
            const double inverse =
                1.0 / (own + up.per_width * conductivity_of(up, t[l]) * bend_of(node, u));
            offset[l] = -excess * inverse;
            follow[l] = up.per_width * inverse;
            loses[l] = own * inverse;
            t_under[l] = t[l];
            bend_under[l] = bend_of(node, u);
        }
    }
}

/// How far the surface nodes go, each a falling equation of its own.
int solve_top(const EnthalpySurface& s, const EnthalpyStage& e, const Eliminated& below) {
    constexpr double settled = 1e-9;  // [K] of the last correction, which is applied
    constexpr int most = 120;
    const EnthalpyColumn& c = e.column;
    const EnthalpyNode& node = c.node[0];
    const bool alone = c.node.size() == 1;
    const EnthalpyLink down = alone ? EnthalpyLink{} : c.link[0];
    alignas(64) double low[W], high[W], rest[W], t[W], under[W], under_slope[W], done[W];
    for (std::size_t l = 0; l < W; ++l) {
        rest[l] = potential_of(down, node.zero + theta_of(node, e.begin[l] + e.by[l]));
        low[l] = coldest_node - node.zero - e.begin[l];
        high[l] = hottest_node - node.zero - e.begin[l];
        done[l] = 0.0;
    }
    for (int i = 0; i < most; ++i) {
        for (std::size_t l = 0; l < W; ++l) {
            t[l] = node.zero + theta_of(node, e.begin[l] + e.by[l]);
        }
        into_ground(s, t, e.skin, e.flux, e.slope);
        if (alone) {
            from_below(s, c, t, e.below, e.below_slope);
            std::copy_n(e.below, W, under);
            std::copy_n(e.below_slope, W, under_slope);
        } else {
            for (std::size_t l = 0; l < W; ++l) {
                const double pull = below.loses[W + l] * down.per_width;
                under[l] = below.flux[l] - pull * (potential_of(down, t[l]) - rest[l]);
                under_slope[l] = -pull * conductivity_of(down, t[l]);
            }
        }
        double left = 0.0;
#pragma omp simd reduction(+ : left)
        for (std::size_t l = 0; l < W; ++l) {
            const double at = e.by[l], u = e.begin[l] + at, bend = bend_of(node, u);
            const double stored = (gain_of(node, e.begin[l], at) - e.target[l]) / e.tau;
            const double excess = e.flux[l] + under[l] - stored;
            low[l] = excess > 0.0 ? at : low[l];
            high[l] = excess > 0.0 ? high[l] : at;
            const double slope =
                heat_slope_of(node, u) / e.tau - (e.slope[l] + under_slope[l]) * bend;
            const double newton = excess / slope;
            double next = at + newton;
            if (node.latent > 0.0) next = halted(node, u, u + newton) - e.begin[l];
            const bool small = std::abs(newton) < settled;
            const bool inside = next > low[l] && next < high[l] && i < 60;
            next = inside || small ? next : 0.5 * (low[l] + high[l]);
            next = done[l] > 0.0 ? at : next;
            done[l] = small || done[l] > 0.0 ? 1.0 : (high[l] - low[l] < 1e-12 ? 1.0 : 0.0);
            e.by[l] = next;
            left += 1.0 - done[l];
        }
        if (left == 0.0) return i + 1;
    }
    return most;
}

/// The other nodes follow. Returns how many lanes' nodes have halted at a bend.
double sweep_downward(const EnthalpyStage& e, const Eliminated& below, const double* rest,
                      bool halting) {
    const EnthalpyColumn& c = e.column;
    const std::size_t n = c.node.size();
    alignas(64) double rise[W];
    double crossed = 0.0;
    for (std::size_t l = 0; n > 1 && l < W; ++l) {
        const EnthalpyNode& top = c.node[0];
        const double t = top.zero + theta_of(top, e.begin[l] + e.by[l]);
        rise[l] = potential_of(c.link[0], t) - rest[l];
    }
    for (std::size_t i = 1; i < n; ++i) {
        const EnthalpyNode& node = c.node[i];
        const EnthalpyLink link = i + 1 < n ? c.link[i] : EnthalpyLink{};
        const double *begin = e.begin + i * W, *offset = below.offset + i * W,
                     *follow = below.follow + i * W;
        double* by = e.by + i * W;
        const double least = coldest_node - node.zero, most = hottest_node - node.zero;
#pragma omp simd reduction(+ : crossed)
        for (std::size_t l = 0; l < W; ++l) {
            const double old = begin[l] + by[l];
            double move = offset[l] + follow[l] * rise[l];
            if (node.latent > 0.0) {
                const double at = halting ? halted(node, old, old + move) : old + move;
                const bool bent =
                    at != old + move || heat_slope_of(node, at) != heat_slope_of(node, old);
                crossed += bent ? 1.0 : 0.0;
                move = at - old;
            }
            const double t = node.zero + theta_of(node, old);
            rise[l] = conductivity_of(link, t) * bend_of(node, old) * move;
            if (node.latent == 0.0 &&
                (link.frozen != link.thawed || c.link[i - 1].frozen != c.link[i - 1].thawed)) {
                const double after = node.zero + theta_of(node, old + move);
                crossed += (t < zero_celsius) != (after < zero_celsius) ? 1.0 : 0.0;
            }
            by[l] = std::min(std::max(old + move, least), most) - begin[l];
        }
    }
    return crossed;
}

/// Fluxes and slopes at both ends where the stage has led. Returns the largest of what is left of
/// the back's balance [W m⁻²], which bends with its film.
double take_down(const EnthalpySurface& s, const EnthalpyStage& e, const double* last_before) {
    const EnthalpyColumn& c = e.column;
    const std::size_t end = (c.node.size() - 1) * W;
    alignas(64) double t[W], flux[W], slope[W];
    double left = 0.0;
    for (std::size_t l = 0; l < W; ++l) {
        t[l] = c.node.back().zero + theta_of(c.node.back(), e.begin[end + l] + e.by[end + l]);
    }
    from_below(s, c, t, flux, slope);
    for (std::size_t l = 0; l < W; ++l) {
        left = std::max(
            left, std::abs(flux[l] - e.below[l] - e.below_slope[l] * (t[l] - last_before[l])));
        e.below[l] = flux[l];
        e.below_slope[l] = slope[l];
        const double top = e.begin[l] + e.by[l];
        const double stored = (gain_of(c.node[0], e.begin[l], e.by[l]) - e.target[l]) / e.tau;
        double under = flux[l];
        if (c.node.size() > 1) {
            const double t0 = c.node[0].zero + theta_of(c.node[0], top);
            const double t1 = c.node[1].zero + theta_of(c.node[1], e.begin[W + l] + e.by[W + l]);
            under =
                c.link[0].per_width * (potential_of(c.link[0], t1) - potential_of(c.link[0], t0));
        }
        e.taken[l] = stored - under;
    }
    return left;
}

EnthalpyCount solve_enthalpy(const EnthalpySurface& s, const EnthalpyStage& e) {
    constexpr int most_passes = 60;
    constexpr double settled = 1e-8;  // [W m⁻²] of a plate's back
    const EnthalpyColumn& c = e.column;
    const std::size_t size = c.node.size() * W;
    Eliminated below{e.work, e.work + size, e.work + 2 * size, {}};
    EnthalpyCount count{.solved = false};
    alignas(64) double rest[W], last[W];
    while (!count.solved && count.passes < most_passes) {
        for (std::size_t l = 0; l < W; ++l) {
            const double u = e.begin[l] + e.by[l];
            rest[l] = c.node.size() == 1
                          ? 0.0
                          : potential_of(c.link[0], c.node[0].zero + theta_of(c.node[0], u));
            last[l] = c.node.back().zero +
                      theta_of(c.node.back(), e.begin[size - W + l] + e.by[size - W + l]);
        }
        sweep_upward(s, e, below);
        count.iterations += solve_top(s, e, below);
        const double bent = sweep_downward(e, below, rest, count.passes < most_passes - 10);
        const double left = take_down(s, e, last);
        ++count.passes;
        if (!(left < 1e9)) return count;  // not a number
        count.solved = bent == 0.0 && (!s.behind || c.node.size() == 1 || left < settled);
    }
    return count;
}

void carry_enthalpy(const EnthalpyStage& e, const double* state, std::size_t columns,
                    double* right) {
    const EnthalpyColumn& c = e.column;
    const std::size_t n = c.node.size();
    double* const follow = e.work;  // [node][lane]
    alignas(64) double diagonal[W], low[W];
    for (std::size_t i = n; i-- > 0;) {
        const EnthalpyNode& node = c.node[i];
        const double* u = state + i * W;
        for (std::size_t l = 0; l < W; ++l) {
            const double t = node.zero + theta_of(node, u[l]), bend = bend_of(node, u[l]);
            double d = heat_slope_of(node, u[l]) / e.tau;
            low[l] = 0.0;
            if (i + 1 == n) {
                d -= e.below_slope[l] * bend;
            } else {
                const EnthalpyLink& link = c.link[i];
                const EnthalpyNode& under = c.node[i + 1];
                const double ui = state[(i + 1) * W + l];
                low[l] = link.per_width * bend_of(under, ui) *
                         conductivity_of(link, under.zero + theta_of(under, ui));
                d += link.per_width * conductivity_of(link, t) * bend -
                     low[l] * follow[(i + 1) * W + l];
            }
            if (i == 0) {
                d -= e.slope[l] * bend;
            } else {
                const EnthalpyLink& up = c.link[i - 1];
                const EnthalpyNode& over = c.node[i - 1];
                const double uo = state[(i - 1) * W + l];
                d += up.per_width * conductivity_of(up, t) * bend;
                follow[i * W + l] = up.per_width * bend_of(over, uo) *
                                    conductivity_of(up, over.zero + theta_of(over, uo)) / d;
            }
            diagonal[l] = 1.0 / d;
        }
        for (std::size_t k = 0; k < columns; ++k) {
            double* row = right + (i * columns + k) * W;
            const double* under = i + 1 < n ? row + columns * W : row;
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) {
                row[l] = (row[l] / e.tau + low[l] * under[l]) * diagonal[l];
            }
        }
    }
    for (std::size_t i = 1; i < n; ++i) {
        for (std::size_t k = 0; k < columns; ++k) {
            double* row = right + (i * columns + k) * W;
            const double *over = row - columns * W, *by = follow + i * W;
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) row[l] += by[l] * over[l];
        }
    }
}

}  // namespace

}  // namespace diurna
