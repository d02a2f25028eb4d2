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

/// The surfaces at an instant with water and snow, for pictures: facets that agree to 1/64 of snow
/// share and of its albedo, and 1/32 of wet share, become one material, their mean. If there are
/// more than `most_states`, the steps are doubled until they fit.
struct CoveredSurfaces {
    static constexpr std::size_t most_states = 256;

    FacetSet facets;                      // with the materials below
    MaterialLibrary materials;            // the scene's, then those under water and snow
    std::vector<MaterialId> of;           // (material) original material in the scene
    std::size_t covered = 0, states = 0;  // facets; materials they have
    double widest = 0.0;                  // largest difference of albedo between facet and material

    std::string note() const;
};

/// Nothing if no picture would change: no snow on more than a thousandth of any facet, and no
/// wetness of a material with a wet_albedo.
///
/// - cover: (place in `facet`)
std::optional<CoveredSurfaces> covered_surfaces(const FacetSet& facets,
                                                const MaterialLibrary& materials,
                                                std::span<const std::uint32_t> facet,
                                                std::span<const SurfaceCover> cover);

/// Replaces the covered materials' numbers by the scene's in the planes `material`,
/// `material_k`.
void name_as_dry(const CoveredSurfaces& surfaces, Frame& frame);

/// The planes `wet_share`, `snow_cover`, `snow_albedo` at the pixels' centres; −1 for sky.
void add_cover_planes(const View& view, std::span<const std::uint32_t> facet,
                      std::span<const SurfaceCover> cover, Frame& frame);

}  // namespace diurna
