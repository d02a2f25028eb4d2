#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "materials/matter/passed_light.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/facet_motion.hpp"
#include "terrain/visibility/ray.hpp"

namespace diurna {

struct EmbreeScene;

/// The scene's triangles, prepared for rays (Embree, robust mode). Queries are thread-safe. A ray
/// exactly through a vertex can miss (Embree issue 174), one through an edge misses about once in a
/// million, so samples are never placed there. Triangles that are not finite or have wrong indices
/// are refused by the functions that build a FacetSet.
class RayScene {
 public:
    /// - passed: (material) light that their facets transmit; empty: none
    /// - copies: second places of some of them
    /// - motion: empty without motion
    explicit RayScene(const FacetSet& facets, std::vector<PassedLight> passed = {},
                      Copies copies = {}, const FacetMotion& motion = {});
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    /// The nearest facet along each ray. Rays are traced 8 at a time in the order given: fastest
    /// if neighbours are similar.
    void closest(std::span<const Ray> rays, std::span<Hit> hits) const;
    /// blocked[i] = 1 if a facet is between near and far.
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

    /// Copies of facets: the facet numbers below include theirs.
    const Copies& copies() const;

    /// The nearest facet's number along the first `lanes` rays, index(no_facet) without a
    /// hit. For rays that go apart: each is traced alone.
    void closest(const RayPacket& rays, int lanes, std::array<std::uint32_t, 16>& facet) const;
    void occluded(const RayPacket& rays, int lanes, std::array<std::uint8_t, 16>& blocked) const;

    /// share[i] of the sun's beam that arrives from outside the scene: the product of the
    /// transmittances of the facets on the ray at their angles.
    void beam(std::span<const Ray> rays, std::span<float> share) const;

    /// A facet along a ray, the nearest first, as long as light continues behind it.
    struct Met {
        std::uint32_t number;  // index(no_facet), the last: the rest escapes
        bool back = false;     // of a sheet
        float share;           // of diffuse thermal light or sunlight absorbed here; the sum is one
    };
    void along(const Ray& ray, bool sunlight, std::vector<Met>& met) const;
    /// Whether a ray that meets this facet needs `along`: light continues, or it may be a back.
    bool to_follow(std::uint32_t met) const {
        if (facets_.empty()) return false;
        const PassedLight& passed = passed_[side_of(met).material];
        return passed.sheet || !passed.beam.empty();
    }

    /// Displacement of a facet's centroid at a time from its position at 0.5 [m].
    Eigen::Vector3d gone(std::uint32_t met, float time) const;

    const EmbreeScene& embree() const { return *embree_; }  // for ray_bundles.cpp

 private:
    struct Side {
        std::uint16_t material;
        Eigen::Vector3f normal;
    };
    const Side& side_of(std::uint32_t met) const { return facets_[copies().at(met).facet]; }
    /// Cosine between a facet's normal at its place and a direction.
    float cosine(std::uint32_t met, const Eigen::Vector3f& direction) const;
    struct Nearest {
        std::uint32_t met;
        float range;
    };
    void nearest(std::span<const Ray> rays, std::span<Nearest> found) const;
    /// The number of the nearest facet beyond ray.near; moves ray.near to it.
    std::uint32_t next(Ray& ray) const;

    std::unique_ptr<EmbreeScene> embree_;
    std::unique_ptr<EmbreeScene> see_through_;  // facets that transmit the sun's beam; null: none
    std::vector<PassedLight> passed_;           // (material)
    std::vector<Side> facets_;                  // (facet); empty if all are opaque and no sheets
};

}  // namespace diurna
