#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray.hpp"

namespace diurna {

/// The rays by which a facet samples what it sees, and so its row of view factors
/// (view_factor_sampling.hpp): stratified, cosine-weighted directions about a facet's normal, each
/// from a point of its own: sixteen neighbouring directions of a packet start from sixteen points
/// spread evenly over the facet. (From one point each, the error on a facet as wide as what it sees
/// was twice as large at 64 rays and four times at 1024.) All lanes are worked out together, since
/// Embree takes less time for them than drawing them one by one would.
class HemisphereRays {
 public:
    HemisphereRays(int rays, std::uint64_t seed);

    std::size_t rays() const { return rays_; }
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

}  // namespace diurna
