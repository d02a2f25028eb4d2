#include "scenes/plan/aspect_place.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "terrain/place/site.hpp"

namespace diurna {

namespace {

/// Of the upright box around an object, along its heading.
Eigen::Vector3d middle_of(const World& world, const std::string& name, double heading_deg) {
    const Eigen::Vector3d front = direction(heading_deg, 0.0);
    const Eigen::Vector3d right = direction(heading_deg + 90.0, 0.0);
    const auto found = std::find(world.objects.begin(), world.objects.end(), name);
    const auto id = static_cast<ObjectId>(found - world.objects.begin());
    Eigen::AlignedBox3d box;
    for (std::size_t f = 0; f < world.facets.size(); ++f) {
        if (world.facets.object[f] != id) continue;
        for (const std::uint32_t corner : world.facets.corner[f]) {
            const Eigen::Vector3d v = world.facets.vertex[corner].cast<double>();
            box.extend(Eigen::Vector3d(v.dot(front), v.dot(right), v.z()));
        }
    }
    const Eigen::Vector3d centre = box.center();
    return centre.x() * front + centre.y() * right + centre.z() * Eigen::Vector3d::UnitZ();
}

}  // namespace

Observer placed_around(Observer observer, const Around& around, const World& world) {
    const Eigen::Vector3d middle = middle_of(world, around.object, around.heading_deg);
    observer.position = middle + around.range * direction(around.heading_deg + around.aspect_deg,
                                                          around.elevation_deg);
    return looking_at(observer, middle);
}

}  // namespace diurna
