#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/visibility/object_boxes.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/sky_basis.hpp"
#include "terrain/visibility/sky_bound.hpp"

namespace diurna {

inline constexpr std::size_t facets_per_block = 128;

/// Queue of rays from many facets, passed on sixteen at a time.
struct RayQueue {
    static constexpr std::size_t room = 32;
    std::array<float, room> origin_x, origin_y, origin_z, direction_x, direction_y, direction_z;
    std::array<std::uint32_t, room> owner;
    std::size_t size = 0;

    /// Appends the k-th ray of a packet if `wanted`.
    void put(const RayPacket& rays, std::size_t k, std::uint32_t from, bool wanted) {
        origin_x[size] = rays.origin_x[k];
        origin_y[size] = rays.origin_y[k];
        origin_z[size] = rays.origin_z[k];
        direction_x[size] = rays.direction_x[k];
        direction_y[size] = rays.direction_y[k];
        direction_z[size] = rays.direction_z[k];
        owner[size] = from;
        size += wanted;
    }
    /// Takes out the first `count`, at most 16.
    void take(std::size_t count, RayPacket& rays, std::array<std::uint32_t, 16>& owners);
};

/// Traces the rays of one block of facets. Rays above everything nearby reach the sky. For the
/// others an occlusion query, the cheapest one, comes first; only if it finds something, or if the
/// ray goes down, the nearest facet is searched, and only if `nearest` is set. Light that continues
/// behind a facet, thermal or solar, is followed.
class BlockRays {
 public:
    /// - ground: facets before this one are ground
    BlockRays(const RayScene& scene, const FacetSet& facets, std::size_t ground, bool nearest,
              bool sunlight)
        : scene_(scene), facets_(facets), ground_(ground), nearest_(nearest), sunlight_(sunlight) {}

    /// The first lanes of a packet, of the block's facet `from`; `sines` of the elevations above
    /// which there is only sky, and a skyline if one is known.
    void trace(const RayPacket& rays, int lanes, std::uint32_t from, const SkyBound::Sines& sines,
               const OpenAbove* skyline = nullptr);
    /// Traces the remaining rays.
    void finish();

    // (facet of the block) rays; `hidden`: those that met the back of a sheet, or the inside of a
    // body in which they started
    std::array<double, facets_per_block> sky{}, below{}, hidden{};
    // (facet of the block) Σ over the hidden part of the sky above the horizontal, ray by ray
    std::array<SkyVector, facets_per_block> covered{};
    std::vector<std::uint32_t> owner;  // (hit) facet of the block; rising after finish()
    struct Seen {
        std::uint32_t met;  // a facet's number (copies.hpp)
        float share;        // of a ray
        bool operator<(const Seen& other) const {
            return met != other.met ? met < other.met : share < other.share;
        }
    };
    std::vector<Seen> seen;  // (hit)

 private:
    void escaped(std::uint32_t from, float up, double share = 1.0) {
        (up >= 0.0f ? sky : below)[from] += share;
    }
    /// Adds a share of the packet's k-th ray, if it points up, to the hidden sky.
    void cover(std::size_t k, float share);
    /// Follows the k-th ray of the packet through transparent facets.
    void follow(std::size_t k);
    void ask_whether(std::size_t count);
    void ask_which(std::size_t count);
    /// Rays that go down were traced before others of the same facets.
    void sort_by_owner();

    /// Whether the packet's k-th ray meets a body from behind.
    bool from_behind(std::size_t k, std::uint32_t met) const;

    const RayScene& scene_;
    const FacetSet& facets_;
    std::size_t ground_;
    bool nearest_, sunlight_;
    RayQueue doubtful_{}, blocked_{};
    RayPacket packet_{};
    std::vector<RayScene::Met> met_{};
    std::array<std::uint32_t, 16> owners_{};
};

}  // namespace diurna
