#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/visibility/ray_bundles.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Directions in which pixels see sky, collected for vectorised conversion to angles.
struct SkyDirections {
    std::vector<std::uint32_t> pixel;
    std::vector<float> x, y, z;             // east, north, up; of any length
    std::vector<float> middle_x, middle_y;  // of the pixel's middle
    std::vector<float> share;               // of the pixel

    std::size_t size() const { return pixel.size(); }
    void add(std::size_t of_pixel, const float* towards, const Eigen::Vector3d& middle,
             float of_share) {
        pixel.push_back(static_cast<std::uint32_t>(of_pixel));
        x.push_back(towards[0]);
        y.push_back(towards[1]);
        z.push_back(towards[2]);
        middle_x.push_back(static_cast<float>(middle.x()));
        middle_y.push_back(static_cast<float>(middle.y()));
        share.push_back(of_share);
    }
};

/// Zenith angle of each, and azimuth of the pixel's centre relative to `axis_azimuth_deg`, −180 to
/// 180. Within 2e-5° (arctangent by Abramowitz & Stegun 4.4.49).
void sky_angles(const SkyDirections& directions, double axis_azimuth_deg,
                std::vector<float>& zenith_deg, std::vector<float>& azimuth_deg);

/// Adds up the directions of a bundle's first `used` lanes that hit nothing, in a fixed order.
///
/// sum      (3) x, y, z, added to
/// returns  their number
std::uint32_t add_open_lanes(const RayBundles& rays, std::size_t bundle, std::size_t used,
                             float* sum);

}  // namespace diurna
