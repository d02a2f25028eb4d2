#include "scenes/job/world/objects.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <variant>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

/// Along the mesh's axes, z upright [m].
Eigen::Vector3d size_of(const ObjectInput& object) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& v : object.mesh->vertex) box.extend(v);
    Eigen::Vector3d size = box.sizes() * object.placing.metres;
    if (object.placing.up == UpAxis::y) std::swap(size.y(), size.z());
    return size;
}

/// A material as it is on an object in flight.
MaterialId in_flight(const ObjectInput& object, const std::string& name,
                     MaterialLibrary& materials) {
    Material moving = materials[materials.find(name)];
    moving.varies = moving.kind();
    moving.name = name + " of " + object.name + " (in flight)";
    const auto* body = std::get_if<BodyFilm>(&moving.thermal.convection);
    moving.thermal.flight = {object.airspeed,
                             body && body->length > 0.0 ? body->length : size_of(object).y()};
    return materials.add(std::move(moving));
}

/// A copy by a name of its own.
MaterialId of_part(const ObjectInput& object, std::size_t part, MaterialId material,
                   MaterialLibrary& materials) {
    Material own = materials[material];
    own.varies = own.kind();
    own.name = part_material_name(object, part);
    return materials.add(std::move(own));
}

}  // namespace

std::string part_material_name(const ObjectInput& object, std::size_t part) {
    return object.material[part] + " of " + object.name + ": " + std::to_string(part) + " " +
           object.mesh->part[part].node;
}

ObjectMesh object_mesh(const ObjectInput& object, MaterialLibrary& materials) {
    std::vector<MaterialId> material;
    for (const std::string& name : object.material) {
        material.push_back(object.airspeed > 0.0 ? in_flight(object, name, materials)
                                                 : materials.find(name));
        if (object.target.given()) {
            material.back() = of_part(object, material.size() - 1, material.back(), materials);
        }
    }
    try {
        return placed_mesh(*object.mesh, object.placing, material);
    } catch (const InputError& error) {
        const Mistake& mistake = error.mistakes().front();
        throw InputError(object.where, fmt::format("\"{}\" {}", object.name, mistake.problem),
                         mistake.hint);
    }
}

double object_height(const ObjectInput& object) { return size_of(object).z(); }

double object_breadth(const ObjectInput& object) {
    Eigen::Vector3d size = size_of(object);
    std::sort(size.data(), size.data() + 3);
    return size.y();
}

double shadow_reach(const ObjectInput& object) {
    const Eigen::Vector3d size = size_of(object);
    return 0.5 * size.head<2>().norm() + 2.0 * size.z();
}

GroundPatch ground_patch(const ObjectInput& object, const Eigen::Vector2d& place) {
    const double reach = shadow_reach(object);
    constexpr double least_edge = 0.15;  // [m] of small objects
    const double edge =
        object.ground_edge > 0.0 ? object.ground_edge : std::max(least_edge, reach / 12.0);
    GroundPatch patch{.ring = {}, .largest_edge = edge / object.finer_edges};
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        patch.ring.push_back(place + reach * Eigen::Vector2d(x, y));
    }
    return patch;
}

}  // namespace diurna
