#pragma once

#include <algorithm>
#include <cmath>

#include "thermal/kernels/enthalpy_faces.hpp"
#include "thermal/kernels/enthalpy_laws.hpp"

// Elimination of the nodes below the surface, upward, and substitution downward.

namespace diurna {

namespace {

/// Equation remaining from the nodes below: see NonlinearColumn::Below.
struct Eliminated {
    double *offset, *follow, *loses;  // [node][lane]
    alignas(64) double flux[W];       // up into the surface node at zero change
};

/// Contribution of the node below to the one above it.
struct FromUnder {
    alignas(64) double flux[W], slope[W];  // up into the unchanged node, and −d/du
};

/// For a link to an eliminated node.
void along_link(const EnthalpyLink& given, const NodeLaw& node, const double* t, const double* u,
                const double* t_under, const double* bend_under, const double* offset,
                const double* loses, FromUnder& from) {
    const EnthalpyLink link = given;
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const double low = conductivity_of(link, t_under[l]) * bend_under[l];
        const double flux = potential_of(link, t_under[l]) - potential_of(link, t[l]);
        from.flux[l] = link.per_width * (flux + low * offset[l]);
        from.slope[l] =
            link.per_width * loses[l] * conductivity_of(link, t[l]) * bend_of(node, u[l]);
    }
}

void sweep_upward(const EnthalpySurface& s, const EnthalpyStage& e, Eliminated& below) {
    const EnthalpyColumn& c = e.column;
    const std::size_t n = c.node.size();
    alignas(64) double t[W], u[W], t_under[W], bend_under[W], rate[W];
    FromUnder from;
    for (std::size_t l = 0; l < W; ++l) rate[l] = 1.0 / e.tau[l];
    for (std::size_t i = n - 1;; --i) {
        const NodeLaw node(c.node[i]);
        const double *begin = e.begin + i * W, *by = e.by + i * W;
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            u[l] = begin[l] + by[l];
            t[l] = node.zero + theta_of(node, u[l]);
        }
        if (i == n - 1) {
            from_below(s, c, t, e.below, e.below_slope);
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) {
                from.flux[l] = e.below[l];
                from.slope[l] = -e.below_slope[l] * bend_of(node, u[l]);
            }
        } else {
            along_link(c.link[i], node, t, u, t_under, bend_under, below.offset + (i + 1) * W,
                       below.loses + (i + 1) * W, from);
        }
        if (i == 0) break;
        const EnthalpyLink up = c.link[i - 1];
        const NodeLaw over(c.node[i - 1]);
        const double *over_begin = begin - W, *over_by = by - W, *target = e.target + i * W;
        double *offset = below.offset + i * W, *follow = below.follow + i * W,
               *loses = below.loses + i * W;
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            const double above = over.zero + theta_of(over, over_begin[l] + over_by[l]);
            const double conducted =
                up.per_width * (potential_of(up, t[l]) - potential_of(up, above));
            const double excess =
                (gain_of(node, begin[l], by[l]) - target[l]) * rate[l] - from.flux[l] + conducted;
            const double own = heat_slope_of(node, u[l]) * rate[l] + from.slope[l];
            const double bend = bend_of(node, u[l]);
            const double inverse = 1.0 / (own + up.per_width * conductivity_of(up, t[l]) * bend);
            offset[l] = -excess * inverse;
            follow[l] = up.per_width * inverse;
            loses[l] = own * inverse;
            t_under[l] = t[l];
            bend_under[l] = bend;
        }
    }
    std::copy_n(from.flux, W, below.flux);
}

/// Substitution in the other nodes. Adds up the lanes in which nodes have halted at a kink.
///
/// rest  [lane] potential of the surface node before its change
void sweep_downward(const EnthalpyStage& e, const Eliminated& below, const double* rest,
                    bool halting, double* bent) {
    const EnthalpyColumn& c = e.column;
    const std::size_t n = c.node.size();
    alignas(64) double rise[W], crossed[W];
    std::fill_n(crossed, W, 0.0);
    if (n > 1) {
        const NodeLaw top(c.node[0]);
        const EnthalpyLink down = c.link[0];
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            rise[l] = potential_of(down, top.zero + theta_of(top, e.begin[l] + e.by[l])) - rest[l];
        }
    }
    for (std::size_t i = 1; i < n; ++i) {
        const NodeLaw node(c.node[i]);
        const EnthalpyLink link = i + 1 < n ? c.link[i] : EnthalpyLink{};
        const double *begin = e.begin + i * W, *offset = below.offset + i * W,
                     *follow = below.follow + i * W;
        double* by = e.by + i * W;
        const double least = coldest_node - node.zero, most = hottest_node - node.zero;
        const double halts = halting && !node.plain ? 1.0 : 0.0, water = node.plain ? 0.0 : 1.0;
        const double two_ways = node.plain && (link.frozen != link.thawed ||
                                               c.link[i - 1].frozen != c.link[i - 1].thawed)
                                    ? 1.0
                                    : 0.0;
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            const double old = begin[l] + by[l], move = offset[l] + follow[l] * rise[l];
            const double to = old + move, stop = halted(node, old, to);
            const double at = halts > 0.0 ? stop : to;
            const double turned =
                (at != to) | (heat_slope_of(node, at) != heat_slope_of(node, old)) ? 1.0 : 0.0;
            const double t = node.zero + theta_of(node, old);
            const double after = node.zero + theta_of(node, to);
            const double thawed = (t < zero_celsius) != (after < zero_celsius) ? 1.0 : 0.0;
            crossed[l] += water * turned + two_ways * thawed;
            rise[l] =
                conductivity_of(link, t) * bend_of(node, old) * (water > 0.0 ? at - old : move);
            by[l] = std::min(std::max(at, least), most) - begin[l];
        }
    }
    std::copy_n(crossed, W, bent);
}

}  // namespace

}  // namespace diurna
