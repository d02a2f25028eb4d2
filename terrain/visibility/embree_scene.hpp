#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/visibility/facet_motion.hpp"
#include "terrain/visibility/ray.hpp"

namespace diurna {

/// Triangles in Embree's hands, behind RayScene and RayBundles: the only place that knows Embree.
struct EmbreeScene {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    const float* vertex = nullptr;     // Embree's own copies, three per vertex
    const float* after = nullptr;      // likewise where they move: `vertex` at time 0, these at 1
    const unsigned* corner = nullptr;  // and three per facet; alike where left out
    /// (facet) the other side of a sheet (two_sides.hpp), index(no_facet) elsewhere; empty: none.
    /// Of two sides Embree has the one of the lower number.
    std::vector<std::uint32_t> other_side;

    EmbreeScene() = default;
    explicit EmbreeScene(const FacetSet& facets, const FacetMotion& motion = {});
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Where the ray meets the facet's plane, kept within the facet's own reach along the ray:
    /// at grazing incidence Embree's float range can be metres off, and so can the plane's where
    /// the ray met just an edge.
    float range(const Ray& ray, unsigned facet, float embree_range) const;

    /// The side that looks at a ray of all that Embree may have met, RTC_INVALID_GEOMETRY_ID too.
    std::uint32_t facing(std::uint32_t met, const Eigen::Vector3f& direction) const {
        if (other_side.empty() || met >= other_side.size()) return met;
        const std::uint32_t other = other_side[met];
        return other == index(no_facet) || looks_at(met, direction) ? met : other;
    }

    /// How far a facet's middle is at a time from where it is at 0.5 [m].
    Eigen::Vector3d gone(unsigned facet, float time) const;

 private:
    Eigen::Vector3d corner_of(unsigned facet, int k, float time = 0.5f) const;
    bool looks_at(std::uint32_t facet, const Eigen::Vector3f& direction) const;
};

/// For rays whose neighbours are alike (RTC_INTERSECT_CONTEXT_FLAG_COHERENT), or scattered.
RTCIntersectContext intersect_context(RTCIntersectContextFlags flags);

}  // namespace diurna
