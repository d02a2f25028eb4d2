#include "scenes/world/upright_box.hpp"

#include <Eigen/Geometry>

#include "terrain/place/site.hpp"

namespace diurna {

FacetSet object_facets(const World& world, ObjectId id) {
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        if (world.copies[c].object == id) return in_place(world.facets, world.copies[c]);
    }
    FacetSet own;
    const FacetSet& all = world.facets;
    for (std::size_t f = 0; f < all.size(); ++f) {
        if (all.object[f] != id) continue;
        const auto first = static_cast<std::uint32_t>(own.vertex.size());
        for (const std::uint32_t v : all.corner[f]) own.vertex.push_back(all.vertex[v]);
        own.corner.push_back({first, first + 1, first + 2});
        own.centroid.push_back(all.centroid[f]);
        own.normal.push_back(all.normal[f]);
        own.area.push_back(all.area[f]);
        own.material.push_back(all.material[f]);
        own.object.push_back(id);
    }
    return own;
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
