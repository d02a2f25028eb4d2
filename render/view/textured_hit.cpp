#include "render/view/textured_hit.hpp"

#include <algorithm>
#include <cmath>

#include "render/view/pixel_rays.hpp"

namespace diurna {

TexturedHit::TexturedHit(const TextureLevels& levels, const Observer& observer, int samples)
    : levels_(levels),
      parallel_(observer.projection == Projection::orthographic),
      apart_(sample_angle(observer, samples)) {}

Blend TexturedHit::at(FacetId facet, const Eigen::Vector3d& from, const Eigen::Vector3d& towards,
                      double range, double walked) const {
    return over(facet, from + range * towards, towards, walked + range, 1.0);
}

Blend TexturedHit::over(FacetId facet, const Eigen::Vector3d& place, const Eigen::Vector3d& towards,
                        double range, double wide) const {
    if (levels_.surfaces_of(facet).count < 2) return {own_surface(facet), own_surface(facet)};
    const double across = std::abs(levels_.facets.normal[index(facet)].cast<double>().dot(towards));
    const double apart = wide * (parallel_ ? apart_ : apart_ * range);
    return levels_.at(facet, place, apart / std::sqrt(std::max(0.01, across)));
}

}  // namespace diurna
