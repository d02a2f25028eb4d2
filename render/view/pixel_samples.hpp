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

/// Where the rays of an observer's pixels go. A pixel has one sample in each cell of a grid over
/// it, as square as their number allows, at a place in the cell that depends on (seed, pixel,
/// sample) alone.
class PixelSamples {
 public:
    PixelSamples(const Observer& observer, int samples, std::uint64_t seed);

    const PixelRays& eye() const { return eye_; }
    const Eigen::Vector3f& origin() const { return origin_; }
    /// How many bundles of rays a pixel's samples fill.
    std::size_t bundles() const { return right_.size() / RayBundles::lanes; }
    /// How many lanes of a bundle hold samples: its first ones. The others repeat the first.
    std::size_t used(std::size_t bundle) const {
        return std::min(RayBundles::lanes, samples_ - bundle * RayBundles::lanes);
    }

    /// How many samples stand side by side in a pixel: they are counted row by row.
    std::size_t columns() const { return columns_; }

    /// Aims one bundle of rays, `at`, at a pixel's samples, from the sixteen times `part`-th on.
    void aim(std::size_t column, std::size_t row, std::size_t part, std::size_t at,
             RayBundles& rays) const;
    /// Aims one at the middles of the 4 x 4 pixels from (column, row) on. Those beyond the last
    /// column and row are moved back to it.
    void aim_middles(std::size_t column, std::size_t row, std::size_t at, RayBundles& rays) const;

 private:
    /// Of a bundle's rays in the picture, from a pixel's corner.
    struct Places {
        alignas(64) float right[RayBundles::lanes], down[RayBundles::lanes];
    };
    void aim_at(std::size_t column, std::size_t row, const Places& places, std::size_t at,
                RayBundles& rays) const;
    /// The time of what moves in the scene, `when` of the row's exposure has gone by.
    void time_at(std::size_t row, const Places& places, std::span<const float> when,
                 std::size_t bundle, RayBundles& rays) const;
    /// Where they begin, `when` of the row's exposure has gone by.
    void start_at(std::size_t column, std::size_t row, const Places& places,
                  std::span<const float> when, std::size_t at, RayBundles& rays) const;
    /// Turns what aim_at() has aimed as the camera has turned by then.
    void turn_at(std::size_t row, const Places& places, std::span<const float> when, std::size_t at,
                 RayBundles& rays) const;

    PixelRays eye_;
    Eigen::Vector3d position_;
    bool starts_differ_;  // orthographic, or the camera moves
    bool takes_time_;
    double row_time_ = 0.0, exposure_ = 0.0;  // in the time of rays
    Eigen::Vector3f origin_;
    std::size_t width_, height_, samples_, columns_ = 1;
    std::uint64_t seed_;
    std::vector<float> right_, down_;  // (sample) where its cell begins [pixels]
    float cell_right_, cell_down_;     // 2⁻¹⁶ of a cell
};

}  // namespace diurna
