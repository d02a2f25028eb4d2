#include "scenes/job/world/elevation.hpp"

namespace diurna {

Dem elevation_of(const Scene& scene) {
    return scene.elevation ? *scene.elevation : read_elevation(scene.terrain.elevation);
}

}  // namespace diurna
