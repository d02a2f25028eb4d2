#pragma once

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/kernels/enthalpy_kernel.hpp"

// A node's temperature, heat and conductivity as functions of its state u, and their kinks: for the
// loops of enthalpy_faces.hpp and enthalpy_loops.hpp. Without branches: one law for all nodes.

namespace diurna {

namespace {

constexpr std::size_t W = enthalpy_lanes;
constexpr double past_kink = 1e-9;                           // past a kink, in u
constexpr double coldest_node = 1.0, hottest_node = 5000.0;  // [K]

/// 1 for a node whose water is frozen below u = 0 and thawed from u = `melted` on (infinite if it
/// drains: snow); 0 for a node without water.
struct NodeLaw {
    double zero, melted;
    double frozen, latent, thawed;
    bool plain;

    explicit NodeLaw(const EnthalpyNode& n)
        : zero(n.zero),
          melted(n.latent == 0.0 ? 0.0
                 : n.drains      ? 1e300
                                 : 1.0),
          frozen(n.latent == 0.0 ? n.thawed : n.frozen),
          latent(n.latent),
          thawed(n.thawed),
          plain(n.latent == 0.0) {}
};
/// [K] T − zero
[[gnu::always_inline]] inline double theta_of(const NodeLaw& n, double u) {
    return std::min(u, 0.0) + std::max(u - n.melted, 0.0);
}
[[gnu::always_inline]] inline double bend_of(const NodeLaw& n, double u) {
    const double solid = u <= 0.0 ? 1.0 : 0.0;
    return u >= n.melted ? 1.0 : solid;
}
[[gnu::always_inline]] inline double heat_slope_of(const NodeLaw& n, double u) {
    const double above = u < n.melted ? n.latent : n.thawed;
    return u <= 0.0 ? n.frozen : above;
}
[[gnu::always_inline]] inline double heat_of(const NodeLaw& n, double u) {
    return n.frozen * std::min(u, 0.0) + n.latent * std::min(std::max(u, 0.0), n.melted) +
           n.thawed * std::max(u - n.melted, 0.0);
}
[[gnu::always_inline]] inline double gain_of(const NodeLaw& n, double u, double by) {
    const double through = heat_of(n, u + by) - heat_of(n, u);
    return n.plain ? n.thawed * by : through;
}
/// Limits a change of a node with water to the first kink.
[[gnu::always_inline]] inline double halted(const NodeLaw& n, double from, double to) {
    const double m = n.melted;
    double at = to;
    at = (from >= 0.0) & (from < m) & (to > m) ? m + past_kink : at;
    at = (from > m) & (to < m) ? m - past_kink : at;
    at = (from > 0.0) & (from <= m) & (to < 0.0) ? -past_kink : at;
    return (from < 0.0) & (to > 0.0) ? past_kink : at;
}

/// ∫k dT above the melting point, and k.
[[gnu::always_inline]] inline double conductivity_of(const EnthalpyLink& link, double t) {
    return t < zero_celsius ? link.frozen : link.thawed;
}
[[gnu::always_inline]] inline double potential_of(const EnthalpyLink& link, double t) {
    return conductivity_of(link, t) * (t - zero_celsius);
}

}  // namespace

}  // namespace diurna
