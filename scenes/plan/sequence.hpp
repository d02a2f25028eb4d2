#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/view/observer.hpp"
#include "scenes/input/scene.hpp"
#include "scenes/world/movers.hpp"
#include "scenes/world/world.hpp"
#include "terrain/raster/dem.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// The pictures of an observer: when, and where from.
struct Sequence {
    std::vector<Instant> frame;  // ascending
    std::vector<Observer> pose;  // (frame); of one that stands the only one

    std::string note{};  // of a place that was drawn; "": none
    bool goes = false;   // or turns after what goes: every frame has its own view
    const Observer& at(std::size_t frame_index) const { return pose[goes ? frame_index : 0]; }
};

/// Of every observer of a scene, placed above the ground. Throws InputError for one that is below
/// it, inside an object, or over no ground where its height is above that.
std::vector<Sequence> sequences(const Scene& scene, const Dem& dem, const World& world,
                                const RayScene& rays, const Movement& movement);

/// The instants of all observers' pictures, ascending, each once.
std::vector<Instant> frames_of(const Scene& scene);

}  // namespace diurna
