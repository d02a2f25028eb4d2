#include "terrain/relief/relief_sun.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "terrain/place/sun.hpp"
#include "terrain/relief/horizon.hpp"
#include "terrain/relief/relief_sun_disc.hpp"
#include "terrain/relief/tile_march.hpp"

namespace diurna {

void sun_fraction(const HeightField& field, const Eigen::Vector3d& direction,
                  std::span<float> fraction, double lift) {
    assert(fraction.size() == field.size());
    const double elevation = std::asin(std::clamp(direction.z(), -1.0, 1.0));
    horizon_near(field, direction, sun_angular_radius, fraction, lift);
    const auto lower = static_cast<float>(std::tan(std::max(0.0, elevation - sun_angular_radius)));
    const auto upper = static_cast<float>(std::tan(std::max(0.0, elevation + sun_angular_radius)));
    for_each_tile_row(field, [&](int, std::size_t first, std::size_t posts) {
        for (float& x : fraction.subspan(first, posts)) {
            if (x >= upper) {
                x = 0.0f;
            } else if (x <= lower && elevation > sun_angular_radius) {
                x = 1.0f;
            } else {
                x = disc_above(x, elevation);
            }
        }
    });
}

}  // namespace diurna
