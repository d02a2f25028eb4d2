#include "scenes/job/world/structures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "scenes/job/world/ground_point.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/movers.hpp"
#include "scenes/job/world/objects.hpp"
#include "scenes/job/world/stance.hpp"
#include "scenes/job/world/targets.hpp"
#include "terrain/place/trajectory.hpp"

namespace diurna {

namespace {

constexpr double off_the_ground = 0.01;  // [m] of sheets that would lie in its plane

/// Neither thick nor lifted: rays could not tell it from the ground it lies on.
bool lies_in_the_ground(const ObjectInput& object) {
    constexpr double apart = 0.005;  // [m]
    return object.stands.over == HeightOver::ground && std::abs(object.stands.metres) < apart &&
           object_height(object) < apart;
}

/// Triangles at the foot of a box's walls: at least a thousandth of the way round it.
double foot_edge(const BoxSpec& spec, double least) {
    return std::max(least, 2e-3 * (spec.width + spec.depth));
}

}  // namespace

std::vector<BoxSpec> box_specs(const Scene& scene, const Dem& dem, const Site& site) {
    std::vector<BoxSpec> boxes;
    for (const Building& building : scene.terrain.buildings) {
        const std::string where =
            fmt::format("{}: building \"{}\"", scene.file.string(), building.name);
        BoxSpec spec{.base = ground_point(dem, site, building.place, where),
                     .width = building.width,
                     .depth = building.depth,
                     .height = building.height,
                     .heading_deg = building.heading_deg,
                     .largest_edge = building.largest_edge,
                     .wall = scene.materials.find(building.wall),
                     .front = scene.materials.find(building.front),
                     .roof = scene.materials.find(building.roof)};
        // Where the ground at its walls is not known, they reach below the lowest corner's, so that
        // no light passes under them.
        double lowest = spec.base.z();
        for (const Eigen::Vector2d& corner : plan_of(spec)) {
            lowest = std::min(lowest, ground_point(dem, site, corner, where).z());
        }
        spec.sunk = spec.base.z() - lowest + 1.0 + scene.terrain.elevation.tolerance;
        spec.lowest_row = foot_edge(spec, building.foot_edge);
        boxes.push_back(spec);
    }
    return boxes;
}

std::vector<WalledPlan> walled_plans(const std::vector<BoxSpec>& boxes,
                                     const std::vector<ShapeBuilding>& shapes) {
    std::vector<WalledPlan> plans;
    for (const BoxSpec& spec : boxes) {
        plans.push_back({plan_of(spec), spec.height, spec.lowest_row});
    }
    for (const auto& [prism, input] : shapes) {
        plans.push_back({counterclockwise(prism.ring), prism.top - prism.bottom, prism.largest_edge,
                         prism.hole});
    }
    return plans;
}

void append_buildings(World& world, const Scene& scene, const std::vector<BoxSpec>& boxes) {
    std::size_t object = scene.terrain.polygons.size();
    for (const BoxSpec& spec : boxes) {
        append_facets(world.facets, box(spec), ObjectId{static_cast<std::uint16_t>(++object)});
    }
}

void refuse_buried(const ObjectInput& object, std::span<const Eigen::Vector3f> vertex,
                   const Dem& dem, const Site& site) {
    if (object.stands.over == HeightOver::ground && object.stands.metres >= 0.0) return;
    double highest = -1e9;  // above the ground at its place
    for (const Eigen::Vector3f& v : vertex) {
        const Eigen::Vector2d plan = v.head<2>().cast<double>();
        const auto below = ground_if_any(dem, site, plan);
        if (!below) return;
        highest = std::max(highest, double{v.z()} - below->z());
        if (highest > 0.0) return;
    }
    throw InputError(object.where,
                     fmt::format("found {:g} for object \"{}\", which puts its highest point "
                                 "{:.2f} m below the ground; expected more than {:.1f}",
                                 object.stands.metres, object.name, -highest,
                                 std::round(10.0 * (object.stands.metres - highest)) / 10.0 + 0.0),
                     "an object may be partly in the ground, not wholly");
}

ObjectId object_id(const Scene& scene, std::size_t object) {
    const TerrainInput& terrain = scene.terrain;
    return ObjectId{static_cast<std::uint16_t>(terrain.polygons.size() + terrain.buildings.size() +
                                               object + 1)};
}

void append_object(World& world, Scene& scene, const Dem& dem, Sheets& sheets, std::size_t object) {
    ObjectInput& input = scene.terrain.objects[object];
    const std::string where = fmt::format("{}: object \"{}\"", scene.file.string(), input.name);
    const ObjectId id = object_id(scene, object);
    Stance stance;
    if (input.trajectory.empty()) {
        stance = stance_of(input, dem, world, where);
    } else {
        stance = ObjectCourse(input, scene, dem, world)
                     .stance(find_trajectory(scene.trajectories, input.trajectory)->begin());
        world.movers.push_back({object, id, stance.pose()});
    }
    if (lies_in_the_ground(input)) {
        stance.base.z() += off_the_ground;
        world.notes.push_back(
            fmt::format("{}: a flat sheet on the ground, raised by {:g} m", where, off_the_ground));
    }
    for (const std::string& note : input.notes) {
        world.notes.push_back(fmt::format("{}: {}", where, note));
    }
    input.placing.base = stance.base;
    input.placing.heading_deg = stance.heading_deg;
    input.placing.pitch_deg = stance.pitch_deg;
    input.placing.roll_deg = stance.roll_deg;
    const ObjectMesh mesh = object_mesh(input, scene.materials);
    refuse_buried(input, mesh.vertex, dem, world.site);
    sheets.append(world.facets, mesh, id);
    if (input.target.given()) {
        TargetFacets target = target_facets(input, object, id, scene.materials);
        target.pose = stance.pose();
        world.targets.push_back(std::move(target));
    }
}

void append_objects(World& world, Scene& scene, const Dem& dem, Sheets& sheets) {
    for (std::size_t object = 0; object < scene.terrain.objects.size(); ++object) {
        if (!scene.terrain.objects[object].copy_of.empty()) continue;
        append_object(world, scene, dem, sheets, object);
    }
}

void append_shape_buildings(World& world, const Scene& scene,
                            std::vector<ShapeBuilding> buildings) {
    const auto& inputs = scene.terrain.shapes;
    std::vector<std::uint16_t> object(inputs.size(), 0);
    for (ShapeBuilding& building : buildings) {
        const ShapesInput& input = inputs[building.input];
        if (object[building.input] == 0) {
            object[building.input] = static_cast<std::uint16_t>(world.objects.size());
            world.objects.push_back(input.name);
        }
        building.prism.wall = scene.materials.find(input.wall);
        building.prism.roof = scene.materials.find(input.roof);
        append_facets(world.facets, prism(building.prism), ObjectId{object[building.input]});
    }
}

}  // namespace diurna
