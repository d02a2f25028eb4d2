#pragma once

#include <cstddef>
#include <vector>

#include "render/rays/secondary_rays.hpp"
#include "render/rays/walk.hpp"
#include "render/view/pixel_rays.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// A pixel's shares by its view, which knows them better than the few samples whose rays are
/// followed: its samples are chosen by the whole picture (render/view/adaptive.hpp).
struct PixelShares {
    float followed = 0.0f;              // of surfaces that need rays, 0 to 1
    std::vector<SecondaryRay> plain{};  // other surfaces and sky, with their shares as weights
};

/// Sky and plain surfaces with the direction of the pixel's centre; sky with the view's zenith
/// angle.
///
/// - view: with all its sightings
/// - eye: of the observer
PixelShares pixel_shares(const View& view, std::size_t pixel, const SecondaryScene& scene,
                         const PixelRays& eye);

}  // namespace diurna
