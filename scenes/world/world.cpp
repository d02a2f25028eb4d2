#include "scenes/world/world.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "materials/base/units.hpp"
#include "terrain/ground/full_grid.hpp"
#include "terrain/ground/ground_mesh.hpp"
#include "terrain/ground/level_of_detail.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/objects/box.hpp"
#include "terrain/objects/prism.hpp"
#include "terrain/raster/class_raster.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geoid.hpp"

namespace diurna {

namespace {

Site resolved_site(const Scene& scene, const Dem& dem) {
    if (!scene.site) {
        const Geodetic centre = dem_centre(dem);
        return {centre.latitude_deg, centre.longitude_deg, centre.height, scene.terrain.refraction};
    }
    Site site = *scene.site;
    site.refraction = scene.terrain.refraction;
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

/// The land cover's material at each triangle's middle; none where it has no class or no table
/// entry.
std::vector<std::optional<MaterialId>> covered(const Scene& scene, const Dem& dem,
                                               const GroundMesh& mesh) {
    std::vector<std::optional<MaterialId>> found(mesh.triangle.size());
    if (!scene.terrain.land_cover) return found;
    std::vector<Eigen::Vector2d> middle;
    std::vector<float> height;
    for (const auto& [a, b, c] : mesh.triangle) {
        middle.push_back((mesh.place[a] + mesh.place[b] + mesh.place[c]) / 3.0);
        height.push_back(mesh.height[a]);
    }
    const ClassRaster raster = read_class_raster(scene.terrain.land_cover->file);
    const auto classes = classes_at(raster, geodetic_places(dem, middle, height));
    for (std::size_t t = 0; t < found.size(); ++t) {
        const auto entry = scene.terrain.land_cover->material.find(classes[t]);
        if (entry != scene.terrain.land_cover->material.end()) {
            found[t] = scene.materials.find(entry->second);
        }
    }
    return found;
}

/// Whether a triangle of raster places holds a post without elevation in the file; one that holds
/// no post at all, whether its middle's cell has such a one.
bool over_void(const Dem& dem, const std::array<Eigen::Vector2d, 3>& corner) {
    const auto is_void = [&](int row, int column) {
        return row >= 0 && column >= 0 && row < dem.rows && column < dem.columns &&
               dem.is_void[std::size_t(row) * dem.columns + column];
    };
    Eigen::Matrix2d edges;
    edges << corner[1] - corner[0], corner[2] - corner[0];
    const Eigen::Matrix2d inverse = edges.inverse();
    const Eigen::Vector2d low = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
    const Eigen::Vector2d high = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
    bool any = false;
    constexpr double near = 1e-3;  // places come from metres kept as float
    for (int row = int(std::ceil(low.y() - near)); row <= int(high.y() + near); ++row) {
        for (int column = int(std::ceil(low.x() - near)); column <= int(high.x() + near);
             ++column) {
            const Eigen::Vector2d at = inverse * (Eigen::Vector2d(column, row) - corner[0]);
            if (at.minCoeff() < -near || at.sum() > 1.0 + near) continue;
            if (is_void(row, column)) return true;
            any = true;
        }
    }
    const Eigen::Vector2d middle = (corner[0] + corner[1] + corner[2]) / 3.0;
    const int left = int(std::floor(middle.x())), above = int(std::floor(middle.y()));
    return !any && (is_void(above, left) || is_void(above, left + 1) || is_void(above + 1, left) ||
                    is_void(above + 1, left + 1));
}

/// Marks the ground facets whose elevation was filled in.
void mark_filled(World& world, const Dem& dem) {
    if (dem.is_void.empty()) return;
    std::vector<Eigen::Vector2d> east_north;
    for (const Eigen::Vector3f& v : world.facets.vertex) {
        east_north.push_back(v.head<2>().cast<double>());
    }
    const auto place = raster_places(dem, world.site, east_north);
    std::vector<std::uint8_t> filled(world.facets.size(), 0);
    for (std::size_t f = 0; f < world.ground_facets; ++f) {
        const auto& [a, b, c] = world.facets.corner[f];
        filled[f] = over_void(dem, {place[a], place[b], place[c]});
        world.filled_facets += filled[f];
    }
    if (world.filled_facets > 0) world.filled = std::move(filled);
}

/// A pixel of each observer, and a hundredth of the distance from each building and polygon.
std::vector<float> slack_of(const Scene& scene, const Dem& dem, const Site& site) {
    if (!(scene.terrain.coarsest > scene.terrain.tolerance)) return {};
    std::vector<Viewpoint> viewpoints;
    const auto add = [&](const Eigen::Vector2d& place, double height, double angle) {
        viewpoints.push_back({raster_places(dem, site, {&place, 1}).front(), height, angle});
    };
    for (const ObserverInput& observer : scene.observers) {
        add(observer.place, observer.height_above_ground,
            radians(observer.horizontal_fov_deg) / observer.width);
    }
    for (const Building& building : scene.terrain.buildings) add(building.place, 0.0, 0.01);
    for (const ObjectInput& object : scene.terrain.objects) add(object.place, 0.0, 0.01);
    for (const GroundPolygon& polygon : scene.terrain.polygons) {
        for (const Eigen::Vector2d& corner : polygon.ring) add(corner, 0.0, 0.01);
    }
    return level_of_detail(dem, viewpoints, std::max(scene.terrain.tolerance, 1e-3),
                           scene.terrain.coarsest);
}

/// Corners of a box's plan.
std::vector<Eigen::Vector2d> plan_of(const BoxSpec& spec) {
    const double heading = radians(spec.heading_deg);
    const Eigen::Vector2d ahead(std::sin(heading), std::cos(heading));
    const Eigen::Vector2d right(ahead.y(), -ahead.x());
    std::vector<Eigen::Vector2d> ring;
    for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}}) {
        ring.push_back(spec.base.head<2>() + x * spec.width * right + y * spec.depth * ahead);
    }
    return ring;
}

/// The buildings of the scene file; each stands with its corners in the ground.
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
                     .wall = scene.materials.find(building.wall),
                     .front = scene.materials.find(building.front),
                     .roof = scene.materials.find(building.roof)};
        // Walls reach below the lowest corner's ground, so that no light passes under them.
        double lowest = spec.base.z();
        for (const Eigen::Vector2d& corner : plan_of(spec)) {
            lowest = std::min(lowest, ground_point(dem, site, corner, where).z());
        }
        spec.sunk = spec.base.z() - lowest + 1.0 + scene.terrain.tolerance;
        boxes.push_back(spec);
    }
    return boxes;
}

/// The network the scene asks for: the full grid, or what the tolerance leaves of it.
GroundMesh ground_of(const Scene& scene, const Dem& dem, const Site& site,
                     const std::vector<Footprint>& footprints) {
    using Mesh = TerrainInput::Mesh;
    const TerrainInput& terrain = scene.terrain;
    const std::size_t triangles = 2 * std::size_t(dem.columns - 1) * std::size_t(dem.rows - 1);
    if (terrain.mesh == Mesh::grid || (terrain.mesh == Mesh::grid_where_it_fits &&
                                       triangles <= TerrainInput::most_grid_triangles)) {
        return ground_mesh(dem, full_grid(dem), terrain.tolerance, footprints);
    }
    return ground_mesh(dem, terrain.tolerance, footprints, slack_of(scene, dem, site));
}

/// Ground of the raster, one object per polygon; the shapes of files lie under the polygons and
/// count as ground. Under `buildings` (rings, east and north) there is none: nobody sees it, and it
/// would meet the walls from behind.
void append_ground(World& world, const Scene& scene, const Dem& dem,
                   const std::vector<std::vector<Eigen::Vector2d>>& buildings) {
    const auto& polygons = scene.terrain.polygons;
    const auto shapes = ground_shapes(scene.terrain.shapes, dem, world.site);
    std::vector<Footprint> footprints;
    std::vector<std::string> material;  // (footprint) "": by land cover and rules
    std::vector<int> object;            // (footprint)
    for (const GroundShape& shape : shapes) {
        footprints.push_back(shape.footprint);
        material.push_back(shape.material);
        object.push_back(0);
    }
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        footprints.push_back(
            {raster_places(dem, world.site, polygons[i].ring), polygons[i].largest_edge});
        material.push_back(polygons[i].material);
        object.push_back(polygons[i].material.empty() ? 0 : static_cast<int>(i) + 1);
    }
    constexpr int nothing = -1;
    for (const auto& ring : buildings) {
        footprints.push_back({raster_places(dem, world.site, ring)});
        material.emplace_back();
        object.push_back(nothing);
    }
    const std::size_t named = footprints.size();
    for (const ObjectInput& input : scene.terrain.objects) {
        const GroundPatch patch = ground_patch(input);
        footprints.push_back({raster_places(dem, world.site, patch.ring), patch.largest_edge});
    }
    const GroundMesh mesh = ground_of(scene, dem, world.site, footprints);
    world.ground_check = check_ground_mesh(dem, mesh);
    const std::vector<Eigen::Vector3d> vertex =
        local_vertices(dem, world.site, mesh.place, mesh.height);
    const auto cover = covered(scene, dem, mesh);

    // A patch around an object is ground of what it lies on.
    const auto footprint_of = [&](std::size_t t) {
        std::int32_t f = mesh.footprint[t];
        if (f < static_cast<std::int32_t>(named)) return f;
        const auto& [a, b, c] = mesh.triangle[t];
        const Eigen::Vector2d middle = (mesh.place[a] + mesh.place[b] + mesh.place[c]) / 3.0;
        for (f = static_cast<std::int32_t>(named) - 1; f >= 0; --f) {
            if (contains(footprints[std::size_t(f)].ring, middle)) break;
        }
        return f;
    };

    // One batch of triangles per object: the ground first, then each polygon.
    for (int batch = 0; batch <= static_cast<int>(polygons.size()); ++batch) {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::vector<MaterialId> materials;
        for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
            const std::int32_t f = footprint_of(t);
            if ((f < 0 ? 0 : object[std::size_t(f)]) != batch) continue;
            const auto& [a, b, c] = mesh.triangle[t];
            triangles.push_back(mesh.triangle[t]);
            if (f >= 0 && !material[std::size_t(f)].empty()) {
                materials.push_back(scene.materials.find(material[std::size_t(f)]));
                continue;
            }
            if (cover[t]) {
                materials.push_back(*cover[t]);
                continue;
            }
            const Eigen::Vector3d across = (vertex[b] - vertex[a]).cross(vertex[c] - vertex[a]);
            const double slope = degrees(std::acos(std::clamp(across.normalized().z(), -1.0, 1.0)));
            const double height = (mesh.height[a] + mesh.height[b] + mesh.height[c]) / 3.0;
            materials.push_back(material_by_rules(scene, slope, height));
        }
        append_facets(world.facets, vertex, triangles, materials,
                      ObjectId{static_cast<std::uint16_t>(batch)});
    }
    world.ground_facets = world.facets.size();
}

/// Footprints of files, one object per file.
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

void append_buildings(World& world, const Scene& scene, const std::vector<BoxSpec>& boxes) {
    std::size_t object = scene.terrain.polygons.size();
    for (const BoxSpec& spec : boxes) {
        append_facets(world.facets, box(spec), ObjectId{static_cast<std::uint16_t>(++object)});
    }
}

void append_objects(World& world, const Scene& scene, const Dem& dem) {
    std::size_t object = scene.terrain.polygons.size() + scene.terrain.buildings.size();
    for (const ObjectInput& input : scene.terrain.objects) {
        const std::string where = fmt::format("{}: object \"{}\"", scene.file.string(), input.name);
        const Eigen::Vector3d ground = ground_point(dem, world.site, input.place, where);
        append_facets(world.facets, object_mesh(input, ground, scene.materials),
                      ObjectId{static_cast<std::uint16_t>(++object)});
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
    if (scene.terrain.reading.geoid) {
        const Geodetic here{world.site.latitude_deg, world.site.longitude_deg, 0.0};
        world.sea_level_height -= geoid_heights({&here, 1}).front();
    }
    world.objects = object_names(scene);
    world.posts = dem.height.size();
    const std::vector<BoxSpec> boxes = box_specs(scene, dem, world.site);
    std::vector<ShapeBuilding> shapes =
        shape_buildings(scene.terrain.shapes, dem, world.site, scene.terrain.tolerance);
    std::vector<std::vector<Eigen::Vector2d>> plans;
    for (const BoxSpec& spec : boxes) plans.push_back(plan_of(spec));
    for (const ShapeBuilding& building : shapes) plans.push_back(building.prism.ring);
    append_ground(world, scene, dem, plans);
    append_buildings(world, scene, boxes);
    append_objects(world, scene, dem);
    append_shape_buildings(world, scene, std::move(shapes));
    mark_filled(world, dem);
    world.relief.emplace(height_field(dem, world.site));
    return world;
}

}  // namespace diurna
