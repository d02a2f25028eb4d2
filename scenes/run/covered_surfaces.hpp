#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "materials/matter/library.hpp"
#include "render/picture/frame.hpp"
#include "render/view/view.hpp"
#include "terrain/facets.hpp"
#include "thermal/covered_facets.hpp"

namespace diurna {

/// The surfaces of an instant under what lies on them, as pictures need them: facets that are alike
/// to 1/64 of snow share and of its albedo, and 1/32 of wet share, are one material, of their mean.
/// Where that makes more than `most_states`, steps are twice, four times ... as wide.
struct CoveredSurfaces {
    static constexpr std::size_t most_states = 256;

    FacetSet facets;                      // with the materials below
    MaterialLibrary materials;            // the scene's, then those under water and snow
    std::vector<MaterialId> of;           // (material) which of the scene's it is
    std::size_t covered = 0, states = 0;  // facets; materials they have
    double widest = 0.0;  // largest difference of a facet's albedo from its material's

    std::string note() const;
};

/// Nothing where no picture would change: no snow on more than a thousandth of any facet, and no
/// wetness of a material with a wet_albedo.
///
/// - cover: (place in `facet`)
std::optional<CoveredSurfaces> covered_surfaces(const FacetSet& facets,
                                                const MaterialLibrary& materials,
                                                std::span<const std::uint32_t> facet,
                                                std::span<const SurfaceCover> cover);

/// Puts the scene's numbers in the place of the covered ones in the planes `material`,
/// `material_k`.
void name_as_dry(const CoveredSurfaces& surfaces, Frame& frame);

/// The planes `wet_share`, `snow_cover`, `snow_albedo` at the pixels' centres; −1 where it is sky.
void add_cover_planes(const View& view, std::span<const std::uint32_t> facet,
                      std::span<const SurfaceCover> cover, Frame& frame);

}  // namespace diurna
