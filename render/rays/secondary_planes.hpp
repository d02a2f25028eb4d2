#pragma once

#include <cstddef>

#include "render/picture/frame.hpp"
#include "render/rays/rough_mirror.hpp"
#include "render/rays/secondary_tables.hpp"

namespace diurna {

/// Fills the planes of surfaces (render/eye/surface_planes.hpp) in the pixels
/// of the secondary rays, so that the radiance can be recomputed there too.
/// The k-th surface is then a secondary ray: a facet, a plume or the sky
/// (facet_k −1) that a ray meets directly, or after another; the most
/// significant ones, each after its predecessor. Its `transmittance` planes
/// include the air and all mirrors, panes, nets and plumes in the path.
/// Further planes:
///
///     way_k      0 direct, 1 through the predecessor, 2 mirrored by it; −1 no surface
///     before_k   number of the predecessor, 1, 2, ...; 0 the eye
///     cosine_k   of the angle between its normal and the line of sight
///
/// and in each band
///
///     mirror_k    reflectance of its interface at that angle (Fresnel's, over the slopes of
///                 waves), mean over a black body at its temperature and the sun
///     passed_k    share transmitted to the predecessor and on to the eye, same mean
///     mirrored_k  W m⁻² sr⁻¹, at the eye: its lobe integral over the sky and the mean of the
///                 surrounding facets, minus the part replaced by surfaces seen in it
///     air_k       W m⁻² sr⁻¹, at the eye: air between it and its predecessor, or the sky itself;
///                 0 for surfaces seen directly, whose air is in `path`
///
///     radiance = Σ_k weight_k (products + behind_k + mirrored_k + air_k) + path + rest
///
/// `rest` is the light after other surfaces that is in none of the listed ones; `unlisted` the
/// directly seen light in none. In pixels without secondary rays the new planes are 0, and way_k
/// follows the number of surfaces.
///
/// - tables: with separate terms
void add_secondary_planes(const SecondaryTables& tables, const RoughMirrors& rough,
                          std::size_t surfaces, Frame& frame);

}  // namespace diurna
