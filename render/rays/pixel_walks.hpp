#pragma once

#include <cstdint>
#include <vector>

#include "render/rays/pixel_shares.hpp"
#include "render/rays/secondary_samples.hpp"
#include "render/rays/walk.hpp"
#include "render/view/observer.hpp"
#include "render/view/pixel_rays.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// A pixel whose rays are followed.
struct AskedPixel {
    std::uint32_t pixel = 0;
    PixelShares shares{};  // empty near a plume, which all its rays may pass
};

/// What samples of a pixel meet.
struct WalkedPixel {
    std::vector<SecondaryRay> seen{};  // merged
    int met = 0;                       // samples that were followed
    std::uint64_t rays = 0;            // traced
};

/// The rays of pixels, followed.
struct PixelWalks {
    const SecondaryScene& scene;
    const Observer& observer;
    const PixelRays& eye;
    const ViewOptions& options;
    const SecondarySampling* sampling;

    /// What a pixel's first samples meet, merged; empty where they meet what the view has already.
    /// And how many samples the pixel wants.
    WalkedPixel first(const AskedPixel& asked, int& wanted) const;
    /// What as many samples as it wants meet.
    ///
    /// - many: rays into lobes
    WalkedPixel all(const AskedPixel& asked, int samples, bool many) const;
};

}  // namespace diurna
