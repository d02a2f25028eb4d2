#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Stratified, cosine-weighted directions about a facet's normal, each from a point of its own:
/// sixteen neighbouring directions of a packet start from sixteen points spread evenly over the
/// facet. (From one point each, the error on a facet as wide as what it sees was twice as large at
/// 64 rays and four times at 1024.) All lanes are worked out together, since Embree takes less time
/// for them than drawing them one by one would.
class SkyRays {
 public:
    SkyRays(int rays, std::uint64_t seed);

    std::size_t packets() const { return (rays_ + 15) / 16; }
    /// How many lanes of a packet hold rays.
    int lanes(std::size_t packet) const {
        return int(std::min<std::size_t>(16, rays_ - 16 * packet));
    }
    /// The facet's rays of one packet; the same for the same seed, facet and packet.
    void fill(const FacetSet& facets, std::size_t facet, std::size_t packet, RayPacket& rays) const;

 private:
    std::size_t rays_;
    std::uint64_t seed_;
    int columns_, rows_;
    std::vector<float> column_, row_;  // (ray) cell of the unit square, padded to whole packets
};

/// Two unit vectors at right angles to `normal` and to each other (Duff et al. 2017).
std::pair<Eigen::Vector3d, Eigen::Vector3d> tangents(const Eigen::Vector3d& normal);

/// A facet's corner and two edges, lifted off it by a few units in the last place of its
/// coordinates, so that no ray meets the facet it starts from.
struct LiftedFacet {
    Eigen::Vector3d normal, corner, to_b, to_c;

    LiftedFacet(const FacetSet& facets, std::size_t facet);
    /// u, v uniform in the unit square give points uniform on the triangle.
    Eigen::Vector3f at(double u, double v) const {
        const double root = std::sqrt(u);
        return (corner + (1.0 - root) * to_b + root * v * to_c).cast<float>();
    }
};

}  // namespace diurna
