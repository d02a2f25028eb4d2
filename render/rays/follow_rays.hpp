#pragma once

#include "render/rays/secondary_rays.hpp"
#include "render/rays/secondary_samples.hpp"
#include "render/rays/walk.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Follows the rays of every pixel of `view` that sees a material that needs_rays() or comes near
/// a plume, `samples` a pixel, and takes these pixels' sightings out of `view`:
/// what they see is in the secondary rays instead. Empty, and nothing cast, where there is no such
/// pixel.
///
/// Where rays into a rough mirror's lobe meet facets, in a pixel or one beside it, its rays are
/// followed again with 64 in the lobe, at most 4 a sample.
///
/// - sampling: if given, its `from` samples tell how many a pixel wants (secondary_samples.hpp);
/// where
///   these are more, they are cast in place of the first, so that choosing does not bias them
SecondaryRays follow_rays(View& view, const SecondaryScene& scene, const Observer& observer,
                          const ViewOptions& options = {},
                          const SecondarySampling* sampling = nullptr);

}  // namespace diurna
