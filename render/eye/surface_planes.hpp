#pragma once

#include <cstddef>

#include "render/eye/eye_tables.hpp"
#include "render/picture/frame.hpp"
#include "render/view/pixel_sun.hpp"

namespace diurna {

/// Adds planes from which a pixel's radiance can be added up anew. Of the k-th (1, 2, ...) of the
/// surfaces that a pixel sees, by their weights:
///
///     weight_k, facet_k, material_k   1   share of the pixel, indices; 0 and −1 where there is
///     none temperature_k                   K sun_fraction_k, sky_view_k      1 cosine_sun_k 1   of
///     the angle between its normal and the sun; 0 or more
///
/// and in each band, light as radiance (W m⁻² sr⁻¹) of a white diffuse surface, factors without
/// unit and 0 where there is no such light:
///
///     black_k         emissivity_k                 transmittance_k
///     sunlight_k      reflectance_sun_k            transmittance_sun_k
///     skylight_k      reflectance_sky_k            transmittance_sky_k
///     surroundings_k  reflectance_surroundings_k   transmittance_surroundings_k
///     behind_k                                     what shines through it, at the eye
///
///     radiance = Σ_k weight_k (sum of the products of these rows + behind_k) + path
///
/// Light as it arrives (black: of a black body at its temperature); emissivity and reflectance its
/// means over the band as that light has it; transmittance the means of the air over what leaves
/// the surface. `path` is the frame's term: air, sky and far plain. What mirrors, panes, nets and
/// plumes show render/rays/secondary_planes.hpp adds; `unlisted` is the share of a pixel that is in
/// no surface and is not sky: where it is 0 the sum is whole. Each mean is that of the band's
/// nodes; the product of a row is the term of the radiance that TERM.BAND holds.
///
/// - eye: with a column for every term
/// - sun: null: every pixel has its facets' mean
void add_surface_planes(const View& view, const SceneLight& light, const EyeTables& eye,
                        const PixelSun* sun, std::size_t surfaces, Frame& frame);

}  // namespace diurna
