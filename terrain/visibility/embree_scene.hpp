#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray.hpp"

namespace diurna {

/// Triangles in Embree's hands, behind RayScene and RayBundles: the only place that knows Embree.
struct EmbreeScene {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    const float* vertex = nullptr;     // Embree's own copies, three per vertex
    const unsigned* corner = nullptr;  // and three per facet

    EmbreeScene() = default;
    explicit EmbreeScene(const FacetSet& facets);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Where the ray meets the facet's plane, kept within the facet's own reach along the ray:
    /// at grazing incidence Embree's float range can be metres off, and so can the plane's where
    /// the ray met just an edge.
    float range(const Ray& ray, unsigned facet, float embree_range) const;

 private:
    Eigen::Vector3d corner_of(unsigned facet, int k) const;
};

/// For rays whose neighbours are alike (RTC_INTERSECT_CONTEXT_FLAG_COHERENT), or scattered.
RTCIntersectContext intersect_context(RTCIntersectContextFlags flags);

}  // namespace diurna
