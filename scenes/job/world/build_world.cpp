#include "scenes/job/world/build_world.hpp"

#include "scenes/job/world/copied_objects.hpp"
#include "scenes/job/world/ground.hpp"
#include "scenes/job/world/ground_marks.hpp"
#include "scenes/job/world/land.hpp"
#include "scenes/job/world/movers.hpp"
#include "scenes/job/world/structures.hpp"
#include "terrain/objects/walls.hpp"

namespace diurna {

namespace {

/// "runway", "hangar", ...: the name of each ObjectId: 0 the ground, then polygons, buildings
/// and objects.
std::vector<std::string> object_names(const Scene& scene) {
    std::vector<std::string> names{"ground"};
    for (const auto& polygon : scene.terrain.polygons) names.push_back(polygon.name);
    for (const auto& building : scene.terrain.buildings) names.push_back(building.name);
    for (const auto& object : scene.terrain.objects) names.push_back(object.name);
    return names;
}

}  // namespace

World build_world(Scene& scene, const Dem& dem) {
    World world;
    const SceneFrame frame =
        frame_of(scene.site, scene.terrain.elevation, dem, scene.file.string() + ": site");
    world.site = frame.site;
    world.sea_level_height = frame.sea_level_height;
    put_at_begin(scene, dem, world);
    world.objects = object_names(scene);
    world.posts = dem.height.size();
    for (const DemDetail& detail : dem.detail) world.posts += detail.raster.height.size();
    std::vector<BoxSpec> boxes = box_specs(scene, dem, world.site);
    auto [shapes, left_out] =
        shape_buildings(scene.terrain.shapes, dem, world.site, scene.terrain.elevation.tolerance);
    world.notes = std::move(left_out);
    // The walls stand on the vertices of the ground round them.
    const std::vector<WalledPlan> plans = walled_plans(boxes, shapes);
    const auto borders = append_ground(world, scene, dem, plans);
    const auto foot_of = [&](std::size_t plan, const Ring& ring) {
        for (const auto& border : borders[plan]) {
            if (goes_round(border, ring)) return border;
        }
        // Where plans overlap: the raster round them.
        return raster_border(ring, plans[plan].foot_edge, dem, world.site);
    };
    std::size_t plan = 0;
    for (BoxSpec& spec : boxes) {
        spec.foot = foot_of(plan, plans[plan].ring);
        ++plan;
    }
    for (ShapeBuilding& building : shapes) {
        building.prism.foot = foot_of(plan, plans[plan].ring);
        for (const Ring& court : plans[plan].hole) {
            building.prism.hole_foot.push_back(foot_of(plan, court));
        }
        ++plan;
    }
    append_buildings(world, scene, boxes);
    Sheets sheets(scene.materials);
    append_objects(world, scene, dem, sheets);
    append_shape_buildings(world, scene, std::move(shapes));
    world.relief.emplace(height_field(dem, world.site));
    append_copies(world, scene, dem, sheets);
    mark_details(world, dem);
    mark_filled(world, dem);
    return world;
}

}  // namespace diurna
