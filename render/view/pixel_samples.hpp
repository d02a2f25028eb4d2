#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/view/observer.hpp"
#include "render/view/pixel_rays.hpp"
#include "terrain/visibility/ray_bundles.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Rays of an observer's pixels. A pixel has one sample in each cell of a grid over it, as
/// square as the number allows, at a position in the cell that depends only on (seed, pixel,
/// sample).
class PixelSamples {
 public:
    PixelSamples(const Observer& observer, int samples, std::uint64_t seed);

    const PixelRays& eye() const { return eye_; }
    const Eigen::Vector3f& origin() const { return origin_; }
    /// Number of bundles of rays for a pixel's samples.
    std::size_t bundles() const { return right_.size() / RayBundles::lanes; }
    /// Number of lanes of a bundle that hold samples: the first ones. The others repeat the first.
    std::size_t used(std::size_t bundle) const {
        return std::min(RayBundles::lanes, samples_ - bundle * RayBundles::lanes);
    }

    /// Number of samples side by side in a pixel: they are counted row by row.
    std::size_t columns() const { return columns_; }

    /// Aims the bundle `at` at a pixel's samples, starting with sample sixteen times `part`.
    void aim(std::size_t column, std::size_t row, std::size_t part, std::size_t at,
             RayBundles& rays) const;
    /// Aims one at the centres of the 4 x 4 pixels from (column, row) on. Those beyond the last
    /// column and row are moved back to it.
    void aim_middles(std::size_t column, std::size_t row, std::size_t at, RayBundles& rays) const;

 private:
    /// Positions of a bundle's rays in the picture, from a pixel's corner.
    struct Places {
        alignas(64) float right[RayBundles::lanes], down[RayBundles::lanes];
    };
    void aim_at(std::size_t column, std::size_t row, const Places& places, std::size_t at,
                RayBundles& rays) const;
    /// Ray times for moving objects, after a fraction `when` of the row's exposure.
    void time_at(std::size_t row, const Places& places, std::span<const float> when,
                 std::size_t bundle, RayBundles& rays) const;
    /// Origins of the rays, after a fraction `when` of the row's exposure.
    void start_at(std::size_t column, std::size_t row, const Places& places,
                  std::span<const float> when, std::size_t at, RayBundles& rays) const;
    /// Rotates the directions of aim_at() by the camera's rotation up to then.
    void turn_at(std::size_t row, const Places& places, std::span<const float> when, std::size_t at,
                 RayBundles& rays) const;

    PixelRays eye_;
    Eigen::Vector3d position_;
    bool starts_differ_;  // orthographic, or moving camera
    bool takes_time_;
    double row_time_ = 0.0, exposure_ = 0.0;  // in units of ray time
    Eigen::Vector3f origin_;
    std::size_t width_, height_, samples_, columns_ = 1;
    std::uint64_t seed_;
    std::vector<float> right_, down_;  // (sample) start of its cell [pixels]
    float cell_right_, cell_down_;     // 2⁻¹⁶ of a cell
};

}  // namespace diurna
