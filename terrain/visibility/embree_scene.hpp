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

/// Triangles in Embree, behind RayScene and RayBundles: only these use Embree.
struct EmbreeScene {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    const float* vertex = nullptr;     // Embree's own copies, three per vertex
    const float* after = nullptr;      // if they move: `vertex` at time 0, these at 1
    const unsigned* corner = nullptr;  // three per facet; all the same if skipped
    /// (facet) the other side of a sheet (two_sides.hpp), index(no_facet) without one; empty: no
    /// sheets. Embree holds the side with the lower number.
    std::vector<std::uint32_t> other_side;
    /// Each is an instance of a scene with its original facets; several may share one.
    Copies copies{};

    EmbreeScene() = default;
    EmbreeScene(const FacetSet& facets, Copies all_copies, const FacetMotion& motion = {});
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// The number of Embree's hit (copies.hpp), from its numbers of triangle and instance;
    /// index(no_facet): no hit.
    std::uint32_t met(unsigned triangle, unsigned instance) const {
        if (instance == RTC_INVALID_GEOMETRY_ID || triangle == RTC_INVALID_GEOMETRY_ID) {
            return triangle;
        }
        return copies.number(instance - 1, triangle);
    }

    /// Range to the facet's plane along the ray, clamped to the facet's own extent along the ray:
    /// at grazing incidence Embree's float range can be metres off, and so can the plane's if the
    /// ray met only an edge.
    float range(const Ray& ray, std::uint32_t met, float embree_range) const;

    /// The side of the hit that faces the ray; index(no_facet) is passed through.
    std::uint32_t facing(std::uint32_t met, const Eigen::Vector3f& direction) const {
        if (other_side.empty() || met == index(no_facet)) return met;
        const std::uint32_t own = copies.at(met).facet, other = other_side[own];
        // Numbers in a copy have the same differences as the original ones.
        return other == index(no_facet) || looks_at(met, direction) ? met : met - own + other;
    }

    /// Displacement of a facet's centroid at a time from its position at 0.5 [m].
    Eigen::Vector3d gone(std::uint32_t met, float time) const;

 private:
    void add_facets(const FacetSet& facets, const FacetMotion& motion);
    void add_copies(const FacetSet& facets);
    /// The facets of a copy, about `origin`.
    RTCScene copied(const FacetSet& facets, const Copy& copy, const Eigen::Vector3d& origin);
    std::array<Eigen::Vector3d, 3> corners_of(std::uint32_t met, float time = 0.5f) const;
    bool looks_at(std::uint32_t met, const Eigen::Vector3f& direction) const;
};

/// For coherent rays (RTC_INTERSECT_CONTEXT_FLAG_COHERENT), or incoherent ones.
RTCIntersectContext intersect_context(RTCIntersectContextFlags flags);

}  // namespace diurna
