#pragma once

#include <memory>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/radiance_input.hpp"
#include "render/light/scene_light.hpp"
#include "render/picture/frame.hpp"
#include "render/rays/plume.hpp"
#include "render/rays/secondary_options.hpp"
#include "render/rays/secondary_rays.hpp"

namespace diurna {

/// Light of the secondary rays of a view at an instant, in every band.
///
///     L = Σ_hops weight · F [ τ_air(range) J + L_path(range) − L_path(range of the secondary ray
///     before) ]
///
/// τ_air is that of light of J's origin (render/light/origin.hpp), and the way past a mirror is one
/// with that to it. F is the product of what the secondary rays before let through (or mirror), J
/// what the secondary ray itself sends: a plume (1 − exp(−k s)) B(T); a facet the terms of
/// radiance.hpp at the angle it is seen at (materials/matter/directional_optics.hpp), its mirrored
/// and transmitted light being that of the secondary rays behind it; the sky its radiance in that
/// direction. Everything in channels (band_channels.hpp), as inside one bin of the atmosphere
/// transmittance is one number, and for all bands at a time (secondary_tables.hpp). Within 5 mK of
/// the sum over nodes, secondary_radiance() (tests/render/secondary_rays_test.cpp).
///
/// By terms: a facet's own count as what they are; behind a pane, a net or a plume everything is
/// `behind`; in a mirror the sky is `sky`, all else `surroundings`. They add up to the whole.
class SecondaryLight {
 public:
    SecondaryLight(const SecondaryRays& secondary_rays, std::span<const Plume> plumes,
                   std::span<const Band> bands, const RadianceInput& input,
                   const SecondaryOptions& options = {});
    /// By the light of a whole picture, whose facets were lit with seen_facets().
    ///
    /// - first: number of the facets before those of the secondary rays
    SecondaryLight(const SecondaryRays& secondary_rays, std::span<const Plume> plumes,
                   const SceneLight& light, std::size_t first, const SecondaryOptions& options);
    ~SecondaryLight();

    /// Adds to the pixels of the secondary rays: planes (band, term), if so asked, or (band) for
    /// the sum of the terms.
    void add(std::span<std::vector<float>> planes) const;
    /// Fills what the frame's planes of surfaces (render/eye/surface_planes.hpp) leave empty in the
    /// pixels of the secondary rays, and adds planes of their own (secondary_planes.hpp). By terms
    /// only.
    void add_surfaces(std::size_t surfaces, Frame& frame) const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diurna
