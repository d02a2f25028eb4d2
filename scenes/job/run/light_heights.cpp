#include "scenes/job/run/light_heights.hpp"

#include "scenes/job/world/heights.hpp"

namespace diurna {

void set_light_heights(const Prepared& prepared, RadianceInput& input) {
    const Scene& scene = prepared.scene;
    if (scene.air.vacuum || scene.air.table) return;
    if (air_by_height(scene, prepared.weather).same_everywhere()) {
        input.light_height_km = input.ground_height_km;
        return;
    }
    input.light_edge_km =
        input.ground_height_km + scene.air.cloud_base_km + scene.air.cloud_depth_km;
}

}  // namespace diurna
