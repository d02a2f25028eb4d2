#pragma once

#include <Eigen/Core>

#include "render/view/observer.hpp"
#include "terrain/texture/texture_levels.hpp"

namespace diurna {

/// Hits on textured facets: one level, or two levels that are mixed there.
///
/// A sample represents a square as wide as the distance to the next sample; on slanting ground
/// widened by the root of its stretching.
class TexturedHit {
 public:
    /// - levels: must outlive it
    /// - samples: a pixel
    TexturedHit(const TextureLevels& levels, const Observer& observer, int samples);

    /// - from, towards: origin and direction of the ray, `towards` a unit vector
    /// - range: [m] along it
    /// - walked: [m] path of a reflected ray before its origin
    Blend at(FacetId facet, const Eigen::Vector3d& from, const Eigen::Vector3d& towards,
             double range, double walked = 0.0) const;

    /// The same at a hit point, for a sample that represents a square `wide` times as
    /// wide.
    Blend over(FacetId facet, const Eigen::Vector3d& place, const Eigen::Vector3d& towards,
               double range, double wide) const;

 private:
    const TextureLevels& levels_;
    bool parallel_;  // rays of the orthographic projection
    double apart_;   // samples: [rad], parallel rays: [m]
};

}  // namespace diurna
