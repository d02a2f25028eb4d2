#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray.hpp"

namespace diurna {

struct EmbreeScene;

/// The scene's triangles, ready for rays (Embree, robust mode). Safe to ask from many threads.
/// A ray aimed exactly at a vertex can slip through (Embree issue 174), one at an edge about once
/// in a million, so samples are never put there. Non-finite or wildly indexed triangles are refused
/// by FacetSet's makers.
class RayScene {
 public:
    explicit RayScene(const FacetSet& facets);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    /// The nearest facet along each ray. Rays are traced 16 at a time in the order given: fastest
    /// where neighbours are alike.
    void closest(std::span<const Ray> rays, std::span<Hit> hits) const;
    /// blocked[i] = 1 if anything lies between near and far.
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

    /// The nearest facet's number along the first `lanes` rays, index(no_facet) where there is
    /// none.
    void closest(const RayPacket& rays, int lanes, std::array<std::uint32_t, 16>& facet) const;
    void occluded(const RayPacket& rays, int lanes, std::array<std::uint8_t, 16>& blocked) const;

    const EmbreeScene& embree() const { return *embree_; }  // for ray_bundles.cpp

 private:
    std::unique_ptr<EmbreeScene> embree_;
};

}  // namespace diurna
