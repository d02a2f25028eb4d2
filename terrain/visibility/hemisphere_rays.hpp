#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray.hpp"

namespace diurna {

/// Rays that sample the hemisphere of a facet for its row of view factors
/// (view_factor_sampling.hpp): stratified, cosine-weighted directions about its normal. The sixteen
/// neighbouring directions of a packet start from sixteen points spread evenly over the facet.
/// (With one starting point, the error for a facet as wide as its surroundings was twice as large
/// at 64 rays and four times at 1024.) All lanes are computed together, since tracing them takes
/// Embree less time than drawing them one by one would.
class HemisphereRays {
 public:
    HemisphereRays(int rays, std::uint64_t seed);

    std::size_t rays() const { return rays_; }
    std::size_t packets() const { return (rays_ + 15) / 16; }
    /// Number of lanes of a packet that hold rays.
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
