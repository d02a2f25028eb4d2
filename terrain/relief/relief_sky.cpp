#include "terrain/relief/relief_sky.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

#include "terrain/place/site.hpp"
#include "terrain/relief/sky_slice.hpp"
#include "terrain/relief/tile_march.hpp"

namespace diurna {

void sky_view(const HeightField& field, int azimuths, std::span<float> sky_view) {
    assert(sky_view.size() == field.size() && azimuths > 0);
    struct Look {
        Eigen::Vector2f towards;
        GridWays ways;
    };
    std::vector<Look> looks;
    for (int k = 0; k < azimuths; ++k) {
        const Eigen::Vector2d towards = direction(360.0 * (k + 0.5) / azimuths, 0.0).head<2>();
        looks.push_back({towards.cast<float>(), GridWays(field, towards)});
    }
    const int columns = field.columns();
    for_each_tile_row(field, [&](int tile_row, std::size_t first, std::size_t posts) {
        std::vector<float> tangent(posts), east(posts), north(posts), up(posts), sum(posts);
        for (std::size_t i = 0; i < posts; ++i) {
            const Eigen::Vector3f n = field.normal(static_cast<int>((first + i) / columns),
                                                   static_cast<int>((first + i) % columns));
            east[i] = n.x();
            north[i] = n.y();
            up[i] = n.z();
        }
        for (const Look& look : looks) {
            march_tiles(field, look.ways, tile_row, {}, tangent);
            const float x = look.towards.x(), y = look.towards.y();
#pragma omp simd
            for (std::size_t i = 0; i < posts; ++i) {
                const float along = x * east[i] + y * north[i];
                const float own = -along / up[i];
                const float t = tangent[i] > own ? tangent[i] : own;
                const float cos2 = 1.0f / (1.0f + t * t);
                sum[i] += up[i] * cos2 + along * (arc_cotangent(t) - t * cos2);
            }
        }
        for (std::size_t i = 0; i < posts; ++i) {
            sky_view[first + i] = std::min(1.0f, sum[i] / static_cast<float>(azimuths));
        }
    });
}

}  // namespace diurna
