#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/texture/surface_id.hpp"
#include "terrain/texture/texture.hpp"

namespace diurna {

/// A texture on a material: the meaning of its values there.
struct Skin {
    std::shared_ptr<const Texture> texture;
    TextureFrame frame{};
    std::vector<MaterialId> material;  // (level) material at the value low + level · step
    double low = 0.0, step = 1.0;      // of the texture's value
    double outside = 0.0;              // value where the texture has none
};
inline constexpr std::uint16_t no_skin = 0xFFFF;

/// Surfaces at a place: a share `second_share` is one of them, the rest the other.
struct Blend {
    SurfaceId first, second;
    float second_share = 0.0f;
};

/// A textured facet becomes several facets in one place, one for each level of the texture that
/// occurs there: each with its own material and heat balance under the same sun, sky and
/// surroundings. A place between two levels is a mixture: its radiance is the sum of both by their
/// shares. For two materials side by side that is exact; for a parameter (albedo, emissivity) it is
/// linear interpolation between two solutions, at each place and for any facet size: midway 0.05 K
/// off between albedos 0.3 apart, 0.07 K between emissivities 0.2 apart (8-12 µm on asphalt, noon
/// and midnight, tests/scenes/textured_scene_test.cpp), growing with the square of the distance.
///
/// The first of a facet's levels has the facet's own number, the others are appended after all
/// facets known to rays, with areas and view factors by their shares of the facet. Numbers of
/// facets and of surfaces are converted here and in surface_id.hpp alone.
struct TextureLevels {
    std::size_t solid = 0;              // facets known to rays, the first of all
    FacetSet facets;                    // one for each surface
    std::vector<std::uint32_t> origin;  // (surface) the solid facet at its place
    std::vector<float> share;           // (surface) of the place

    bool empty() const { return of_facet.empty(); }  // no textures: nothing else is set
    /// The facet, as rays know it, on which a surface lies.
    FacetId facet_of(SurfaceId surface) const {
        return empty() ? FacetId{number(surface)} : FacetId{origin[index(surface)]};
    }
    SurfacesOfFacet surfaces_of(FacetId facet) const {
        if (empty()) return {facet};
        const OfFacet& of = of_facet[index(facet)];
        return {facet, of.first_copy, of.levels};
    }
    /// spacing  [m] to the next place requested
    Blend at(FacetId facet, const Eigen::Vector3d& place, double spacing = 0.0) const;

    struct OfFacet {
        std::uint16_t skin = no_skin, first_level = 0, levels = 1;
        std::uint32_t first_copy = 0;
    };
    std::vector<Skin> skin;
    std::vector<OfFacet> of_facet;  // (solid facet)
};

/// skin_of  (facet) index into `skins`, or no_skin
TextureLevels split_by_texture(const FacetSet& facets, std::vector<Skin> skins,
                               std::span<const std::uint16_t> skin_of);

}  // namespace diurna
