#pragma once

#include <span>

#include "render/rays/plume.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/followed_rays.hpp"
#include "scenes/job/plan/sequence.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Light of rays that go on, in each picture of a band, and through smoke.
struct FollowedLight {
    double secondary = 0.0;  // hits (FollowedRays::secondary)
    double lobes = 0.0;      // roots of the pixels in lobes
    double smoke = 0.0;      // pixels
};

/// What pictures of observers take.
struct PictureWork {
    double pictures = 0.0, pixels = 0.0;                  // of bands
    double surface_pixels = 0.0;                          // and surfaces of pixels (`surfaces`)
    double channel_pictures = 0.0, channel_pixels = 0.0;  // of cubes
    double followed_rays = 0.0;      // that go on, of all views and instruments' views
    double smoke_rays = 0.0;         // through smoke, of the same
    double textured_rays = 0.0;      // that meet textured facets, of the same
    FollowedLight onward{};          // of bands
    FollowedLight of_instruments{};  // of their pictures
    double largest_view = 0.0;       // [bytes]
    double largest_other = 0.0;      // of a view of a scene with an uncertain value changed
    double standing_views = 0.0;     // of observers that stand, all together
};

/// - rays, sequences: of the observers; without them no pixel sends rays on
PictureWork picture_work(const Scene& scene, const World& world, const Weather& weather,
                         const RayScene* rays, std::span<const Sequence> sequences,
                         std::span<const Plume> plumes);

}  // namespace diurna
