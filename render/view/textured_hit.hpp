#pragma once

#include <Eigen/Core>

#include "render/view/observer.hpp"
#include "terrain/texture/texture_levels.hpp"

namespace diurna {

/// What a ray finds on textured facets: a facet or two of whose levels it is a mixture there.
///
/// A sample stands for a square as wide as the distance to the next sample, on slanting ground by
/// the root of what that stretches it.
class TexturedHit {
 public:
    /// - levels: to outlive it
    /// - samples: a pixel
    TexturedHit(const TextureLevels& levels, const Observer& observer, int samples);

    /// - from, towards: where the ray starts and goes to, `towards` a unit vector
    /// - range: [m] along it
    /// - walked: [m] behind the ray where it starts, of one that has been reflected
    Blend at(FacetId facet, const Eigen::Vector3d& from, const Eigen::Vector3d& towards,
             double range, double walked = 0.0) const;

    /// The same at a place that it meets, for a sample that stands for `wide` times as wide a
    /// square.
    Blend over(FacetId facet, const Eigen::Vector3d& place, const Eigen::Vector3d& towards,
               double range, double wide) const;

 private:
    const TextureLevels& levels_;
    bool parallel_;  // rays, as the orthographic projection has them
    double apart_;   // samples: [rad], parallel rays: [m]
};

}  // namespace diurna
