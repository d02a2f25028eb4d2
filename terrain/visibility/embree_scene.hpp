#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/visibility/copies.hpp"
#include "terrain/visibility/facet_motion.hpp"
#include "terrain/visibility/ray.hpp"

namespace diurna {

/// Triangles in Embree's hands, behind RayScene and RayBundles: the only place that knows Embree.
struct EmbreeScene {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    const float* vertex = nullptr;     // Embree's own copies, three per vertex
    const float* after = nullptr;      // likewise where they move: `vertex` at time 0, these at 1
    const unsigned* corner = nullptr;  // and three per facet; alike where skipped
    /// (facet) the other side of a sheet (two_sides.hpp), index(no_facet) elsewhere; empty: none.
    /// Of two sides Embree has the one of the lower number.
    std::vector<std::uint32_t> other_side;
    /// An instance each, of a scene with the facets that it is a copy of; several share one.
    Copies copies{};

    EmbreeScene() = default;
    EmbreeScene(const FacetSet& facets, Copies all_copies, const FacetMotion& motion = {});
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// The number of what Embree has met (copies.hpp), by its numbers of triangle and instance;
    /// index(no_facet): nothing.
    std::uint32_t met(unsigned triangle, unsigned instance) const {
        if (instance == RTC_INVALID_GEOMETRY_ID || triangle == RTC_INVALID_GEOMETRY_ID) {
            return triangle;
        }
        return copies.number(instance - 1, triangle);
    }

    /// Where the ray meets the facet's plane, kept within the facet's own reach along the ray:
    /// at grazing incidence Embree's float range can be metres off, and so can the plane's where
    /// the ray met just an edge.
    float range(const Ray& ray, std::uint32_t met, float embree_range) const;

    /// The side that looks at a ray of all that it may have met, index(no_facet) too.
    std::uint32_t facing(std::uint32_t met, const Eigen::Vector3f& direction) const {
        if (other_side.empty() || met == index(no_facet)) return met;
        const std::uint32_t own = copies.at(met).facet, other = other_side[own];
        // In one place numbers stand as far apart as the facets' own.
        return other == index(no_facet) || looks_at(met, direction) ? met : met - own + other;
    }

    /// How far a facet's middle is at a time from where it is at 0.5 [m].
    Eigen::Vector3d gone(std::uint32_t met, float time) const;

 private:
    void add_facets(const FacetSet& facets, const FacetMotion& motion);
    void add_copies(const FacetSet& facets);
    /// Those of a copy, about `origin`.
    RTCScene copied(const FacetSet& facets, const Copy& copy, const Eigen::Vector3d& origin);
    std::array<Eigen::Vector3d, 3> corners_of(std::uint32_t met, float time = 0.5f) const;
    bool looks_at(std::uint32_t met, const Eigen::Vector3f& direction) const;
};

/// For rays whose neighbours are alike (RTC_INTERSECT_CONTEXT_FLAG_COHERENT), or scattered.
RTCIntersectContext intersect_context(RTCIntersectContextFlags flags);

}  // namespace diurna
