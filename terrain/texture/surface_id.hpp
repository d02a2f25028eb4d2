#pragma once

#include <cstddef>
#include <cstdint>

#include "terrain/facets.hpp"

namespace diurna {

/// Number of a surface: what has one material and one temperature, and what pictures show. A facet
/// (FacetId) is a triangle that rays meet. Without texture the two are the same and have the same
/// number; on a textured facet lie several surfaces, one for each level of its texture
/// (texture_levels.hpp). Arrays (facet of the scene) of the heat balance and of pictures have one
/// value for each surface.
enum class SurfaceId : std::uint32_t {};

constexpr std::size_t index(SurfaceId id) { return static_cast<std::size_t>(id); }
constexpr std::uint32_t number(SurfaceId id) { return static_cast<std::uint32_t>(id); }
/// The surface at a place in such an array.
constexpr SurfaceId surface_id(std::size_t place) {
    return SurfaceId{static_cast<std::uint32_t>(place)};
}
/// A facet's own surface: the first of its levels, or the only one.
constexpr SurfaceId own_surface(FacetId facet) {
    return SurfaceId{static_cast<std::uint32_t>(facet)};
}

/// The surfaces on a facet, the own one first; the others are numbered in sequence.
struct SurfacesOfFacet {
    FacetId facet;
    std::uint32_t first_copy = 0, count = 1;

    SurfaceId operator[](std::uint32_t level) const {
        return level == 0 ? own_surface(facet) : SurfaceId{first_copy + level - 1};
    }
};

}  // namespace diurna
