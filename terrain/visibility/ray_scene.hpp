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

/// The scene's triangles, ready for rays (Embree, robust mode). Safe to ask from many threads.
/// A ray aimed exactly at a vertex can slip through (Embree issue 174), one at an edge about once
/// in a million, so samples are never put there. Non-finite or wildly indexed triangles are refused
/// by FacetSet's makers.
class RayScene {
 public:
    /// - passed: (material) what their facets let through; empty: nothing
    /// - copies: further places of some of them
    /// - motion: empty where nothing moves
    explicit RayScene(const FacetSet& facets, std::vector<PassedLight> passed = {},
                      Copies copies = {}, const FacetMotion& motion = {});
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    /// The nearest facet along each ray. Rays are traced 16 at a time in the order given: fastest
    /// where neighbours are alike.
    void closest(std::span<const Ray> rays, std::span<Hit> hits) const;
    /// blocked[i] = 1 if anything lies between near and far.
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

    /// Where facets stand besides: the numbers below are those of Copies.
    const Copies& copies() const;

    /// The nearest facet's number along the first `lanes` rays, index(no_facet) where there is
    /// none.
    void closest(const RayPacket& rays, int lanes, std::array<std::uint32_t, 16>& facet) const;
    void occluded(const RayPacket& rays, int lanes, std::array<std::uint8_t, 16>& blocked) const;

    /// share[i] of the sun's beam that comes through from beyond everything: the product of what
    /// the facets between let through at their angles.
    void beam(std::span<const Ray> rays, std::span<float> share) const;

    /// What stands along a ray, the nearest first, as long as light goes on behind it.
    struct Met {
        FacetId facet;      // its number; no_facet, the last: nothing more, what is left escapes
        bool back = false;  // of a sheet
        float share;        // of diffuse heat, or sunlight, that ends here; they add up to one
    };
    void along(const Ray& ray, bool sunlight, std::vector<Met>& met) const;
    /// Whether a ray that meets this facet is one for `along`: light goes on, or a back may be met.
    bool to_follow(std::uint32_t met) const {
        if (facets_.empty()) return false;
        const PassedLight& passed = passed_[side_of(met).material];
        return passed.sheet || !passed.beam.empty();
    }

    /// How far a facet's middle is at a time from where it is at 0.5 [m].
    Eigen::Vector3d gone(std::uint32_t met, float time) const;

    const EmbreeScene& embree() const { return *embree_; }  // for ray_bundles.cpp

 private:
    struct Side {
        std::uint16_t material;
        Eigen::Vector3f normal;
    };
    const Side& side_of(std::uint32_t met) const { return facets_[copies().at(met).facet]; }
    /// Of a facet's normal in its place and a direction.
    float cosine(std::uint32_t met, const Eigen::Vector3f& direction) const;
    struct Nearest {
        std::uint32_t met;
        float range;
    };
    void nearest(std::span<const Ray> rays, std::span<Nearest> found) const;
    /// The number of the nearest facet beyond ray.near; moves that there.
    std::uint32_t next(Ray& ray) const;

    std::unique_ptr<EmbreeScene> embree_;
    std::vector<PassedLight> passed_;  // (material)
    std::vector<Side> facets_;         // (facet); empty where all are opaque and none a sheet
};

}  // namespace diurna
