#include "scenes/world.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "materials/units.hpp"
#include "terrain/ground_mesh.hpp"

namespace diurna {

namespace {

Site resolved_site(const Scene& scene, const Dem& dem) {
    if (!scene.site) {
        const Geodetic centre = dem_centre(dem);
        return {centre.latitude_deg, centre.longitude_deg, centre.height};
    }
    Site site = *scene.site;
    if (std::isnan(site.height)) {
        site.height = height_at(dem, site.latitude_deg, site.longitude_deg);
        if (std::isnan(site.height)) {
            throw InputError(scene.file.string() + ": site",
                             fmt::format("{:.5f}, {:.5f} lies outside {} or over a void",
                                         site.latitude_deg, site.longitude_deg, dem.source));
        }
    }
    return site;
}

MaterialId material_by_rules(const Scene& scene, double slope_deg, double height) {
    for (const GroundRule& rule : scene.terrain.rules) {
        if (slope_deg >= rule.least_slope_deg && slope_deg <= rule.most_slope_deg &&
            height >= rule.least_height && height <= rule.most_height) {
            return scene.materials.find(rule.material);
        }
    }
    return scene.materials.find(scene.terrain.default_material);
}

/// Ground of the raster, one object per polygon.
void append_ground(World& world, const Scene& scene, const Dem& dem) {
    const auto& polygons = scene.terrain.polygons;
    std::vector<Footprint> footprints;
    for (const GroundPolygon& polygon : polygons) {
        footprints.push_back({raster_places(dem, world.site, polygon.ring), polygon.largest_edge});
    }
    const GroundMesh mesh = ground_mesh(dem, scene.terrain.tolerance, footprints);
    world.ground_check = check_ground_mesh(dem, mesh);
    const std::vector<Eigen::Vector3d> vertex =
        local_vertices(dem, world.site, mesh.place, mesh.height);

    // One batch of triangles per object: the ground first, then each polygon.
    for (int footprint = -1; footprint < static_cast<int>(polygons.size()); ++footprint) {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::vector<MaterialId> materials;
        for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
            if (mesh.footprint[t] != footprint) continue;
            const auto& [a, b, c] = mesh.triangle[t];
            triangles.push_back(mesh.triangle[t]);
            if (footprint >= 0 && !polygons[footprint].material.empty()) {
                materials.push_back(scene.materials.find(polygons[footprint].material));
                continue;
            }
            const Eigen::Vector3d across = (vertex[b] - vertex[a]).cross(vertex[c] - vertex[a]);
            const double slope = degrees(std::acos(std::clamp(across.normalized().z(), -1.0, 1.0)));
            const double height = (mesh.height[a] + mesh.height[b] + mesh.height[c]) / 3.0;
            materials.push_back(material_by_rules(scene, slope, height));
        }
        const bool ground = footprint < 0 || polygons[footprint].material.empty();
        append_facets(world.facets, vertex, triangles, materials,
                      ObjectId{static_cast<std::uint16_t>(ground ? 0 : footprint + 1)});
    }
    world.ground_facets = world.facets.size();
}

void append_buildings(World& world, const Scene& scene, const Dem& dem) {
    std::size_t object = scene.terrain.polygons.size();
    for (const Building& building : scene.terrain.buildings) {
        const std::string where =
            fmt::format("{}: building \"{}\"", scene.file.string(), building.name);
        const double heading = radians(building.heading_deg);
        const Eigen::Vector2d ahead(std::sin(heading), std::cos(heading));
        const Eigen::Vector2d right(ahead.y(), -ahead.x());
        BoxSpec spec{.base = ground_point(dem, world.site, building.place, where),
                     .width = building.width,
                     .depth = building.depth,
                     .height = building.height,
                     .heading_deg = building.heading_deg,
                     .wall = scene.materials.find(building.wall),
                     .front = scene.materials.find(building.front),
                     .roof = scene.materials.find(building.roof)};
        // Walls reach below the lowest corner's ground, so that no light passes under them.
        double lowest = spec.base.z();
        for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {-0.5, 0.5}, {0.5, -0.5}, {0.5, 0.5}}) {
            const Eigen::Vector2d corner =
                building.place + x * building.width * right + y * building.depth * ahead;
            lowest = std::min(lowest, ground_point(dem, world.site, corner, where).z());
        }
        spec.sunk = spec.base.z() - lowest + 1.0 + scene.terrain.tolerance;
        append_facets(world.facets, box(spec), ObjectId{static_cast<std::uint16_t>(++object)});
    }
}

}  // namespace

Eigen::Vector3d ground_point(const Dem& dem, const Site& site, const Eigen::Vector2d& place,
                             const std::string& where) {
    const Geodetic below = to_geodetic(site, {place.x(), place.y(), 0.0});
    const double height = height_at(dem, below.latitude_deg, below.longitude_deg);
    if (std::isnan(height)) {
        throw InputError(where,
                         fmt::format("east {:g} m, north {:g} m lies outside {} or over a void",
                                     place.x(), place.y(), dem.source));
    }
    return to_local(site, {below.latitude_deg, below.longitude_deg, height});
}

World build_world(const Scene& scene, const Dem& dem) {
    World world;
    world.site = resolved_site(scene, dem);
    world.sea_level_height = world.site.height;
    world.objects = object_names(scene);
    world.posts = dem.height.size();
    append_ground(world, scene, dem);
    append_buildings(world, scene, dem);
    world.relief.emplace(height_field(dem, world.site));
    return world;
}

}  // namespace diurna
