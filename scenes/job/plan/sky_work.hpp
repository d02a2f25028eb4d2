#pragma once

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"

namespace diurna {

/// Rays of the view factors of one stage of moving objects, and what they meet: estimated from
/// the boxes around objects as seen from some of the ground's facets.
struct SkyWork {
    double ground_rays = 0.0;   // of ground, with those added near objects
    double ground_hits = 0.0;   // of these, the ones that objects stop
    double network_rays = 0.0;  // of objects with a thermal network
    double wall_rays = 0.0;     // of other objects and of buildings
    double close_ground = 0.0;  // facets of ground from which objects hide a fifth of the sky
    double sampled = 0.0;       // entries of their rows, and
    double entries = 0.0;       // once these are reciprocal
};

/// Within a factor of 1.5 for rays and 2.5 for entries (tests/scenes/plan_test.cpp). Takes less
/// than 50 ms.
SkyWork sky_work(const Scene& scene, const World& world);

}  // namespace diurna
