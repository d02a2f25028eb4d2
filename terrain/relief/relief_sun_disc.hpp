#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "terrain/place/sun.hpp"
#include "terrain/relief/linear_table.hpp"

namespace diurna {

/// Share of a disc above a straight edge that lies x radii below its centre, −1 ≤ x ≤ 1:
/// 1 − (arccos x − x √(1 − x²)) / π.
inline double share_above_edge(double x) {
    return 1.0 - (std::acos(x) - x * std::sqrt(1.0 - x * x)) / std::numbers::pi;
}

/// The share of the sun's disc above a horizon of the given tangent, 0 to 1. The horizon is assumed
/// straight across the disc.
inline float disc_above(float horizon_tangent, double sun_elevation) {
    const double x = (sun_elevation - std::atan(double{horizon_tangent})) / sun_angular_radius;
    if (x >= 1.0) return 1.0f;
    if (x <= -1.0) return 0.0f;
    return static_cast<float>(share_above_edge(x));
}

/// share_above_edge for any x, from a table: faster, to 1e-4.
class DiscTable {
 public:
    float operator()(float x) const {
        return share_(std::clamp(0.5f * (x + 1.0f), 0.0f, 1.0f) * cells);
    }

 private:
    static constexpr int cells = 256;
    LinearTable<cells> share_{[](int i) { return share_above_edge(2.0 * i / cells - 1.0); }};
};

}  // namespace diurna
