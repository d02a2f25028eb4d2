#pragma once

#include <cstddef>

#include "render/picture/frame.hpp"
#include "render/rays/rough_mirror.hpp"
#include "render/rays/secondary_tables.hpp"

namespace diurna {

/// Fills the planes of surfaces (render/eye/surface_planes.hpp) in the pixels of the secondary
/// rays, so that there, too, the radiance can be added up anew. The k-th surface is then a
/// secondary ray: a facet, a plume or the sky (facet_k −1) that a ray meets straight, or past
/// another; those that count most, each behind the one before it. Its `transmittance` planes are
/// those of the air and of all that light has to pass, by mirrors, panes, nets and plumes. Further
/// planes of it,
///
///     way_k      0 seen straight, 1 through the one before, 2 mirrored by it; −1 there is none
///     before_k   number of that one, 1, 2, ...; 0 the eye
///     cosine_k   of the angle between its normal and the line of sight
///
/// and in each band
///
///     mirror_k    reflectance of its interface at that angle (Fresnel's, over the slopes of
///     waves),
///                 the mean over a black body as warm and the sun
///     passed_k    the share that is let pass to the one before and on to the eye, the same mean
///     mirrored_k  W m⁻² sr⁻¹, at the eye: what it mirrors at large, of the sky and of the mean of
///                 the facets around, less what surfaces that are seen in it have in their place
///     air_k       W m⁻² sr⁻¹, at the eye: air between it and the one before, or the sky itself;
///                 0 of what is seen straight, whose air is in `path`
///
///     radiance = Σ_k weight_k (products + behind_k + mirrored_k + air_k) + path + rest
///
/// `rest` is what is seen past others and is none of the surfaces listed; `unlisted` what is seen
/// straight and is none. In pixels without secondary rays the new planes are 0, way_k as there are
/// surfaces.
///
/// - tables: with terms apart
void add_secondary_planes(const SecondaryTables& tables, const RoughMirrors& rough,
                          std::size_t surfaces, Frame& frame);

}  // namespace diurna
