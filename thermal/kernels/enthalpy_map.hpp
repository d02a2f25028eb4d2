#pragma once

#include "thermal/kernels/enthalpy_laws.hpp"

// Effect of a step of columns with freezing water on small deviations of its start.

namespace diurna {

namespace {

/// Rows of one node: row = own · row + low · under, in single precision, and by · over downward.
struct MapWeights {
    alignas(64) float own[W], low[W];
};

/// Elimination of one node: its weights, and its dependence on the node above it.
void weigh_node(const EnthalpyStage& e, const double* tau, const double* state, const double* taken,
                std::size_t i, double* follow, MapWeights& weights) {
    const EnthalpyColumn& c = e.column;
    const std::size_t n = c.node.size();
    const NodeLaw node(c.node[i]), under(c.node[std::min(i + 1, n - 1)]),
        over(c.node[i ? i - 1 : 0]);
    const EnthalpyLink down = i + 1 < n ? c.link[i] : EnthalpyLink{};
    const EnthalpyLink up = i > 0 ? c.link[i - 1] : EnthalpyLink{};
    const double *u = state + i * W, *begin = e.begin + i * W;
    const double *uu = state + (i + 1 < n ? i + 1 : i) * W, *uo = state + (i > 0 ? i - 1 : 0) * W;
    const double* const next = follow + (i + 1 < n ? W : 0);  // for the last node 0 · itself
    const double first = i == 0 ? 1.0 : 0.0, last = i + 1 == n ? 1.0 : 0.0;
    if (i + 1 == n) std::fill_n(follow, W, 0.0);
#pragma omp simd
    for (std::size_t l = 0; l < W; ++l) {
        const double t = node.zero + theta_of(node, u[l]), bend = bend_of(node, u[l]);
        const double low = down.per_width * bend_of(under, uu[l]) *
                           conductivity_of(down, under.zero + theta_of(under, uu[l]));
        const double ends = first * e.slope[l] + last * e.below_slope[l];
        const double d = heat_slope_of(node, u[l]) / tau[l] - low * next[l] +
                         bend * (down.per_width * conductivity_of(down, t) +
                                 up.per_width * conductivity_of(up, t) - ends);
        const double inverse = 1.0 / d;
        const double goes = taken[l] > 0.0 ? 1.0 : 0.0;
        const double own = heat_slope_of(node, begin[l]) / tau[l] * inverse;
        weights.own[l] = float(goes > 0.0 ? own : 1.0);
        weights.low[l] = float(goes * low * inverse);
        follow[l] = goes * inverse * up.per_width * bend_of(over, uo[l]) *
                    conductivity_of(up, over.zero + theta_of(over, uo[l]));
    }
}

void carry_enthalpy(const EnthalpyStage& e, const double* tau, const double* state,
                    const double* taken, std::size_t columns, float* map) {
    const std::size_t n = e.column.node.size(), row = columns * W;
    double* const follow = e.work;  // [node][lane]
    MapWeights weights;
    for (std::size_t i = n; i-- > 0;) {
        weigh_node(e, tau, state, taken, i, follow + i * W, weights);
        float* const here = map + i * row;
        const float* const under = i + 1 < n ? here + row : here;
        for (std::size_t k = 0; k < row; k += W) {
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) {
                here[k + l] = weights.own[l] * here[k + l] + weights.low[l] * under[k + l];
            }
        }
    }
    for (std::size_t i = 1; i < n; ++i) {
        float* const here = map + i * row;
        const float* const over = here - row;
        alignas(64) float by[W];
        for (std::size_t l = 0; l < W; ++l) by[l] = float(follow[i * W + l]);
        for (std::size_t k = 0; k < row; k += W) {
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) here[k + l] += by[l] * over[k + l];
        }
    }
}

}  // namespace

}  // namespace diurna
