#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/view/observer.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/movers.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/raster/dem.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// The pictures of an observer: instants and poses.
struct Sequence {
    std::vector<Instant> frame;  // ascending
    std::vector<Observer> pose;  // (frame); a single one for an observer at rest

    std::string note{};  // on a random aspect; "": none
    bool goes = false;   // moves, or follows something: a new view for every frame
    const Observer& at(std::size_t frame_index) const { return pose[goes ? frame_index : 0]; }
};

/// For every observer of a scene, placed above the ground. Throws InputError for one that is below
/// the ground, inside an object, or outside the raster if its height is above ground.
std::vector<Sequence> sequences(const Scene& scene, const Dem& dem, const World& world,
                                const RayScene& rays, const Movement& movement);

/// The instants of all observers' pictures, ascending, without duplicates.
std::vector<Instant> frames_of(const Scene& scene);

}  // namespace diurna
