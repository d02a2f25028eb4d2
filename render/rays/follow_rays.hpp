#pragma once

#include "render/rays/secondary_rays.hpp"
#include "render/rays/secondary_samples.hpp"
#include "render/rays/walk.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Follows the rays of every pixel of `view` that sees a material that needs_rays() or
/// is near a plume, `samples` a pixel, and removes these pixels' sightings from `view`:
/// they are in the secondary rays instead. Empty, and no rays, if there is no such
/// pixel.
///
/// A pixel's shares of such materials, of other surfaces and of sky remain the view's: followed
/// samples only find what is behind, in mirrors and in panes (not near a plume, where all are
/// followed).
///
/// If rays in a rough mirror's lobe meet facets, in a pixel or a neighbour, its rays are followed
/// again with 64 in the lobe, at most 4 per sample.
///
/// - sampling: if given, its `from` samples determine the number for each pixel
///   (secondary_samples.hpp), more where a small share is missed by them; if this is larger, a new
///   set is cast in place of the first, so that the choice does not bias the result
SecondaryRays follow_rays(View& view, const SecondaryScene& scene, const Observer& observer,
                          const ViewOptions& options = {},
                          const SecondarySampling* sampling = nullptr);

}  // namespace diurna
