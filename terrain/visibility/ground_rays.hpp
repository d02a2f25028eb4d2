#pragma once

#include <algorithm>
#include <cstddef>

/// Numbers of rays with which ground near objects samples its view: 2 to 64 times as many as open
/// ground, 4096 at most.
namespace diurna {

inline constexpr int most_times_rays = 64, most_ground_rays = 4096;

/// Levels of so many rays and of 2, 4, ... 64 times as many.
inline std::size_t ray_levels(int rays) {
    std::size_t levels = 1;
    for (int times = 2; times <= most_times_rays && rays * times <= most_ground_rays; times *= 2) {
        ++levels;
    }
    return levels;
}

/// Which of them suits ground from which so much of the sky is hidden: in streets and courtyards,
/// where all ground is near objects, no more than four times as many rays. Most on ground divided
/// finely around objects, where a camera that is close sees each facet.
///
/// - hidden: share of the sky, 0 to 1
/// - area: [m²] of the facet
/// - levels: ray_levels()
inline std::size_t finer_level(double hidden, float area, std::size_t levels) {
    constexpr float finely = 2.0f;  // [m²]
    std::size_t wanted = hidden < 0.05 ? 5 : hidden < 0.2 ? 4 : hidden < 0.5 ? 2 : 1;
    if (area < finely && hidden < 0.02) wanted = 6;
    return std::min(wanted, levels - 1);
}

/// Rays of such a facet.
inline int rays_near_objects(int rays, double hidden, float area) {
    return rays << finer_level(hidden, area, ray_levels(rays));
}

}  // namespace diurna
