#include "scenes/job/world/upright_box.hpp"

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "scenes/job/world/some_facets.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

FacetSet object_facets(const World& world, ObjectId id) {
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        if (world.copies[c].object == id) return in_place(world.facets, world.copies[c]);
    }
    std::vector<std::uint32_t> own;
    for (std::uint32_t f = 0; f < world.facets.size(); ++f) {
        if (world.facets.object[f] == id) own.push_back(f);
    }
    return some_facets(world.facets, own);
}

std::optional<UprightBox> upright_box(const FacetSet& facets, ObjectId id, double heading_deg) {
    const Eigen::Vector3d front = direction(heading_deg, 0.0);
    const Eigen::Vector3d right = direction(heading_deg + 90.0, 0.0);
    Eigen::AlignedBox3d box;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (facets.object[f] != id) continue;
        for (const std::uint32_t corner : facets.corner[f]) {
            const Eigen::Vector3d v = facets.vertex[corner].cast<double>();
            box.extend(Eigen::Vector3d(v.dot(front), v.dot(right), v.z()));
        }
    }
    if (box.isEmpty()) return std::nullopt;
    const Eigen::Vector3d centre = box.center(), size = box.sizes();
    return UprightBox{
        centre.x() * front + centre.y() * right + centre.z() * Eigen::Vector3d::UnitZ(), size.x(),
        size.y(), size.z()};
}

}  // namespace diurna
