#pragma once

#include <cstddef>

#include "render/eye/eye_tables.hpp"
#include "render/picture/frame.hpp"
#include "render/view/linear_facets.hpp"
#include "render/view/pixel_sun.hpp"

namespace diurna {

/// Adds planes from which a pixel's radiance can be recomputed. For the k-th (1, 2, ...) of the
/// surfaces that a pixel sees, by their weights:
///
///     weight_k, facet_k, material_k           1   share of the pixel, indices; 0 and −1: none
///     temperature_k                           K
///     sun_fraction_k, sky_view_k, cosine_sun_k  1   cosine between normal and sun; 0 or more
///
/// and in each band, light as radiance (W m⁻² sr⁻¹) of a white diffuse surface, factors without
/// unit and 0 where there is no such light:
///
///     black_k         emissivity_k                 transmittance_k
///     sunlight_k      reflectance_sun_k            transmittance_sun_k
///     skylight_k      reflectance_sky_k            transmittance_sky_k
///     surroundings_k  reflectance_surroundings_k   transmittance_surroundings_k
///     behind_k                                     transmitted from behind it, at the eye
///
///     radiance = Σ_k weight_k (sum of the products of these rows + behind_k) + path
///
/// Light is incident light (black: of a black body at its temperature); emissivity and reflectance
/// are band means weighted by that light; transmittance is the mean of the air weighted by the
/// light leaving the surface. `path` is the frame's term: air, sky and far plain. Mirrors, panes,
/// nets and plumes are added by render/rays/secondary_planes.hpp; `unlisted` is the share of a
/// pixel that is neither a surface nor sky: if it is 0 the sum is complete. Each mean is over the
/// band's nodes; the product of a row is the term of the radiance in TERM.BAND.
///
/// - eye: with a column for every term
/// - sun, ground: null: every pixel has its facets' mean
void add_surface_planes(const View& view, const SceneLight& light, const EyeTables& eye,
                        const PixelSun* sun, const LinearFacets* ground, std::size_t surfaces,
                        Frame& frame);

}  // namespace diurna
