#pragma once

#include <span>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/sequence.hpp"
#include "scenes/job/world/world.hpp"

namespace diurna {

/// What pictures of observers take.
struct PictureWork {
    double pictures = 0.0, pixels = 0.0;                  // of bands
    double channel_pictures = 0.0, channel_pixels = 0.0;  // of cubes
    double followed_rays = 0.0;                           // that go on, one by one
    double onward = 0.0;        // of bands: roots of the pixels that send rays on
    double largest_view = 0.0;  // [bytes]
};

/// - sequences: of the observers; without them no pixel sends rays on
PictureWork picture_work(const Scene& scene, const World& world,
                         std::span<const Sequence> sequences);

}  // namespace diurna
