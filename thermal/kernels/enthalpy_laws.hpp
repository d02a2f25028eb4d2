#pragma once

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/kernels/enthalpy_kernel.hpp"

// How a node's temperature, heat and conductivity follow its state u, and where they bend: for the
// loops of enthalpy_faces.hpp and enthalpy_loops.hpp.

namespace diurna {

namespace {

constexpr std::size_t W = enthalpy_lanes;
constexpr double past_kink = 1e-9;                           // beyond a bend, in u
constexpr double coldest_node = 1.0, hottest_node = 5000.0;  // [K]

[[gnu::always_inline]] inline double theta_of(const EnthalpyNode& n, double u) {
    if (n.latent == 0.0) return u;
    return std::min(u, 0.0) + (n.drains ? 0.0 : std::max(u - 1.0, 0.0));
}
[[gnu::always_inline]] inline double bend_of(const EnthalpyNode& n, double u) {
    if (n.latent == 0.0) return 1.0;
    return u <= 0.0 || (!n.drains && u >= 1.0) ? 1.0 : 0.0;
}
[[gnu::always_inline]] inline double heat_slope_of(const EnthalpyNode& n, double u) {
    if (n.latent == 0.0) return n.thawed;
    return u <= 0.0 ? n.frozen : (n.drains || u < 1.0 ? n.latent : n.thawed);
}
[[gnu::always_inline]] inline double heat_of(const EnthalpyNode& n, double u) {
    const double most = n.drains ? 1e300 : 1.0;
    return n.frozen * std::min(u, 0.0) + n.latent * std::min(std::max(u, 0.0), most) +
           n.thawed * std::max(u - most, 0.0);
}
[[gnu::always_inline]] inline double gain_of(const EnthalpyNode& n, double u, double by) {
    return n.latent == 0.0 ? n.thawed * by : heat_of(n, u + by) - heat_of(n, u);
}
/// ∫k dT from melting on, and k.
[[gnu::always_inline]] inline double conductivity_of(const EnthalpyLink& link, double t) {
    return t < zero_celsius ? link.frozen : link.thawed;
}
[[gnu::always_inline]] inline double potential_of(const EnthalpyLink& link, double t) {
    return conductivity_of(link, t) * (t - zero_celsius);
}
/// As far as the first bend on the way.
[[gnu::always_inline]] inline double halted(const EnthalpyNode& n, double from, double to) {
    double at = to;
    if (!n.drains) {
        at = from >= 0.0 && from < 1.0 && to > 1.0 ? 1.0 + past_kink : at;
        at = from > 1.0 && to < 1.0 ? 1.0 - past_kink : at;
    }
    at = from > 0.0 && from <= 1.0 && to < 0.0 ? -past_kink : at;
    return from < 0.0 && to > 0.0 ? past_kink : at;
}

}  // namespace

}  // namespace diurna
