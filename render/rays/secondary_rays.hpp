#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/texture/surface_id.hpp"

namespace diurna {

/// One hit of a ray on its path through panes, nets and plumes and off mirrors.
struct SecondaryRay {
    enum class Kind : std::uint8_t { facet, plume, sky };
    enum class Way : std::uint8_t { direct, through, mirrored };  // after the one before

    Kind kind = Kind::sky;
    Way way = Way::direct;
    bool closed = false;     // facet: rays end here, whatever its material
    bool straight = true;    // on the line of sight: no mirror in the path
    std::uint32_t what = 0;  // number of the surface or plume
    std::int32_t before =
        -1;  // the secondary ray before, counted in the pixel's own list; −1: the eye
    float weight = 0.0f;  // share of the pixel
    float range = 0.0f;   // [m] along the path; plume: to its middle
    float height = 0.0f;  // [m] above the origin's level surface
    float cosine = 1.0f;  // facet: of the angle to its normal
    float chord = 0.0f;   // plume [m]
    Eigen::Vector3f direction = Eigen::Vector3f::UnitZ();  // unit, of the incoming ray

    SurfaceId surface() const { return SurfaceId{what}; }
};

/// Hits of the rays of pixels that see a pane, a net, a mirror or a plume: for a static view
/// computed once, like View.
struct SecondaryRays {
    std::vector<std::uint32_t> pixel;  // ascending
    std::vector<std::uint32_t> row;  // (pixel + 1) secondary rays of pixel k: [row[k], row[k + 1])
    std::vector<SecondaryRay> secondary;  // of a pixel: each before those behind it
    double observer_height = 0.0;         // [m] above the origin's level surface
    std::uint64_t rays = 0;               // traced to find them

    bool empty() const { return secondary.empty(); }
    std::span<const SecondaryRay> of(std::size_t k) const {
        return std::span(secondary).subspan(row[k], row[k + 1] - row[k]);
    }
};

/// Every surface in the secondary rays, ascending, each once.
std::vector<SurfaceId> surfaces_of(const SecondaryRays& secondary_rays);
/// Surfaces in a picture: the targets of its view, then surfaces_of() the secondary rays.
std::vector<SurfaceId> seen_surfaces(std::span<const SurfaceId> targets,
                                     const SecondaryRays& secondary_rays);

}  // namespace diurna
