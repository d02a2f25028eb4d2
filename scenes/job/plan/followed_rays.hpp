#pragma once

#include <optional>
#include <vector>

#include "render/view/adaptive.hpp"
#include "render/view/observer.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// What pixels of a picture take that see water, a mirror, a pane or a net.
struct FollowedRays {
    double pixels = 0.0;
    double in_lobes = 0.0;   // of these, of rough mirrors and water, whose light comes from lobes
    double rays = 0.0;       // traced for them
    double secondary = 0.0;  // of these, hits that are kept (SecondaryRays::secondary)
};

/// How a picture's rays are followed.
struct FollowedOptions {
    int samples = 16;
    std::optional<AdaptiveOptions> by_need{};  // adaptive_secondary()
    double wind_speed = 3.0;                   // [m s⁻¹] over water
    std::size_t looked_at = 96;                // pixels, at most, to find what is in front
    std::size_t blocks = 16;                   // of 3 x 3 pixels, at most, that are followed
};

/// From some of the pixels, chosen by the solid angles of facets of such materials: their rays are
/// followed as in a run (follow_rays()). Temperatures, which decide the number of samples, are not
/// known before a run: facets are taken to be as warm as surfaces in the sun.
FollowedRays followed_rays(const Scene& scene, const World& world, const RayScene& rays,
                           const Observer& pose, const FollowedOptions& options);

}  // namespace diurna
