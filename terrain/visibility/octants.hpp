#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace diurna {

/// Eighths of the compass, each between an axis and a diagonal. Bit 0 of its number is set for
/// west, bit 1 for south, bit 2 if nearer to east or west than to north or south.
using ByOctant = std::array<float, 8>;

/// The octant of a direction with these east and north components.
inline std::size_t compass_octant(float east, float north) {
    return std::size_t(east < 0.0f) | std::size_t(north < 0.0f) << 1 |
           std::size_t(std::abs(east) > std::abs(north)) << 2;
}

inline constexpr float cos_half_octant = 0.92387953f, sin_half_octant = 0.38268343f;  // of 22.5°

/// East and north of the middles of the octants.
struct OctantMiddles {
    ByOctant east{}, north{};
    constexpr OctantMiddles() {
        for (std::size_t k = 0; k < 8; ++k) {
            const bool flat = k & 4;
            east[k] = (k & 1 ? -1.0f : 1.0f) * (flat ? cos_half_octant : sin_half_octant);
            north[k] = (k & 2 ? -1.0f : 1.0f) * (flat ? sin_half_octant : cos_half_octant);
        }
    }
};
inline constexpr OctantMiddles octant_middles;

/// Maximum slope within each octant of a plane that rises this much per metre east and north: along
/// one of the octant's two borders, or directly uphill.
inline ByOctant steepest_rise(float east, float north) {
    ByOctant rise;
    constexpr float diagonal = 0.70710678f;
    for (std::size_t k = 0; k < 8; ++k) {
        const float x = k & 1 ? -east : east, y = k & 2 ? -north : north;
        const float on_axis = k & 4 ? x : y, on_diagonal = diagonal * (x + y);
        rise[k] = std::max({on_axis, on_diagonal, 0.0f});
    }
    rise[compass_octant(east, north)] = std::hypot(east, north);
    return rise;
}

}  // namespace diurna
