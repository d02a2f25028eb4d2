#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <span>

#include "render/view/observer.hpp"
#include "terrain/facets.hpp"

namespace diurna {

/// A camera at one pose.
class PosedCamera {
 public:
    explicit PosedCamera(const Observer& observer);
    /// Pixels that a facet fills, ignoring occlusion; 0 outside the picture.
    double pixels_of(const Eigen::Vector3d& centroid, const Eigen::Vector3d& normal,
                     double area) const;

 private:
    const Observer& observer_;
    Eigen::Matrix3d axes_;  // to right, forward, up
};

/// Number of pixels of a picture with facets of materials for which `counts` holds, ignoring
/// occlusion: from solid angles of facets that face the camera within its field of view. Needs no
/// rays; only for the estimate of a plan.
///
/// - counts: (material)
double seen_pixels(const Observer& observer, const FacetSet& facets,
                   const std::function<bool(MaterialId)>& counts);

/// Number of facets of which pictures show a pixel, ignoring occlusion: from the same solid angles,
/// of at most `most_looked_at` facets and poses, evenly chosen.
double seen_facets(std::span<const Observer> poses, const FacetSet& facets);
/// Poses of a trajectory at which what is seen is counted.
inline constexpr std::size_t most_poses = 12;
inline constexpr std::size_t most_looked_at = 2'000'000;

}  // namespace diurna
