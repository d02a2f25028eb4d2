#pragma once

#include <vector>

#include "render/view/observer.hpp"
#include "scenes/job/world/movers.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Finds eyes that are below the ground or inside an object, with moving objects at given poses.
class EyeCheck {
 public:
    /// - rays: of the world's facets, with moving objects at the start of their trajectories
    /// - both must outlive it
    EyeCheck(const World& world, const RayScene& rays);
    /// Throws InputError as check_observer() (render/view/observer.hpp).
    ///
    /// - poses: of the moving objects
    void check(const Observer& observer, const MoverPoses& poses) const;

 private:
    struct Part {
        FacetSet facets;
        RayScene rays;
        Part(const World& world, const std::vector<std::uint32_t>& facet);
    };
    const World& world_;
    const RayScene& rays_;
    std::vector<Part> still_;  // one, without moving objects; empty without motion
    std::vector<Part> going_;  // (mover) at its start
};

}  // namespace diurna
