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
/// τ_air is that for light of J's origin (render/light/origin.hpp), and the path behind a mirror is
/// joined with that to it. F is the product of the transmittances (or reflectances) of the
/// preceding secondary rays, J the radiance of the secondary ray itself: a plume (1 − exp(−k s))
/// B(T); a facet the terms of radiance.hpp at its viewing angle
/// (materials/matter/directional_optics.hpp), with its reflected and transmitted light from the
/// secondary rays behind it; the sky its radiance in that direction. Everything in channels
/// (band_channels.hpp), as transmittance is constant inside one bin of the atmosphere, and for all
/// bands at a time (secondary_tables.hpp). Within 5 mK of the sum over nodes, secondary_radiance()
/// (tests/render/secondary_rays_test.cpp).
///
/// By terms: a facet's own terms keep their names; everything behind a pane, a net or a plume is
/// `behind`; in a mirror the sky is `sky`, all else `surroundings`. They add up to the whole.
class SecondaryLight {
 public:
    SecondaryLight(const SecondaryRays& secondary_rays, std::span<const Plume> plumes,
                   std::span<const Band> bands, const RadianceInput& input,
                   const SecondaryOptions& options = {});
    /// Uses the light of a whole picture, whose facets were lit with seen_surfaces().
    ///
    /// - first: number of the facets before those of the secondary rays
    SecondaryLight(const SecondaryRays& secondary_rays, std::span<const Plume> plumes,
                   const SceneLight& light, std::size_t first, const SecondaryOptions& options);
    ~SecondaryLight();

    /// Adds to the pixels of the secondary rays: planes (band, term) with terms, or (band) for the
    /// sum of the terms.
    void add(std::span<std::vector<float>> planes) const;
    /// Fills the pixels of the secondary rays in the frame's
    /// planes of surfaces (render/eye/surface_planes.hpp), and
    /// adds their own planes (secondary_planes.hpp). Only with
    /// terms.
    void add_surfaces(std::size_t surfaces, Frame& frame) const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diurna
