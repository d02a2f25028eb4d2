#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "terrain/place/instant.hpp"
#include "terrain/visibility/sky_basis.hpp"
#include "thermal/weather/sky_shape.hpp"

namespace diurna {

/// Distribution of scattered sunlight over the sky at an instant, as shares of its irradiance on
/// level ground: L = [ (1 − circumsolar) / π + Σ c_k (f_k − T_k of level ground) ] E, in the even
/// functions of terrain/visibility/sky_basis.hpp with the sun towards x, k = 1 to 9.
struct SkySpread {
    double circumsolar = 0.0;                            // 0 to 1, on level ground
    std::array<float, even_sky_functions - 1> uneven{};  // c_k [sr⁻¹]
};

/// The same over a span, linear in time between its instants and constant outside.
struct SkySpreads {
    std::vector<Instant> instant;  // ascending, while the sun is up; not empty
    std::vector<SkySpread> spread;

    /// - to_sun: unit, east-north-up
    DiffuseSplit at(Instant when, const Eigen::Vector3d& to_sun) const;
};

}  // namespace diurna
