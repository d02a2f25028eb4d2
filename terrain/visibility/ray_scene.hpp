#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "terrain/facets.hpp"

namespace diurna {

struct Ray {
    Eigen::Vector3f origin;     // east-north-up [m]
    float near = 0.0f;          // [m] along the direction
    Eigen::Vector3f direction;  // unit
    float far = 1e30f;
};

struct Hit {
    FacetId facet = no_facet;  // no_facet: nothing was hit
    float range = 0.0f;        // [m], recomputed in double from the facet's corners
};

/// Sixteen rays side by side, from 0 to infinity, that have little in common.
struct RayPacket {
    alignas(64) std::array<float, 16> origin_x, origin_y, origin_z;
    alignas(64) std::array<float, 16> direction_x, direction_y, direction_z;  // unit
};

enum class Coherence { coherent, incoherent };  // neighbouring rays alike, or scattered

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

    /// The nearest facet along each ray. Rays are traced 16 at a time in the order given.
    void closest(std::span<const Ray> rays, std::span<Hit> hits,
                 Coherence coherence = Coherence::coherent) const;
    /// The nearest facet's number along the first `lanes` rays, index(no_facet) where there is
    /// none.
    void closest(const RayPacket& rays, int lanes, std::array<std::uint32_t, 16>& facet) const;
    /// blocked[i] = 1 if anything lies between near and far.
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                  Coherence coherence = Coherence::coherent) const;
    void occluded(const RayPacket& rays, int lanes, std::array<std::uint8_t, 16>& blocked) const;

 private:
    friend class RayBundles;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Bundles of sixteen rays that are much alike, the samples of a pixel each, laid side by side so
/// that whole rows of pixels can be prepared, traced and read in turn. From 0 to infinity, all
/// sixteen lanes in use. For one thread.
class RayBundles {
 public:
    static constexpr std::size_t lanes = 16;
    RayBundles(const RayScene& scene, std::size_t most);
    ~RayBundles();
    RayBundles(const RayBundles&) = delete;
    RayBundles& operator=(const RayBundles&) = delete;

    // (bundle, lane) To be written: where rays begin [m], and their unit directions.
    float *origin_x, *origin_y, *origin_z;
    float *direction_x, *direction_y, *direction_z;
    void set_origin(const Eigen::Vector3f& origin);  // of all of them

    /// The nearest facet of each ray of the first few bundles.
    void closest(std::size_t bundles);
    const std::uint32_t* facet;  // (bundle, lane) index(no_facet): nothing was hit
    const float* range;  // (bundle, lane) [m]; recomputed in double at grazing incidence (below
                         // 3°), within 2e-5 of it elsewhere

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diurna
