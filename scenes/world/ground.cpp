#include "scenes/world/ground.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "materials/air/sight_line.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "scenes/world/viewpoints.hpp"
#include "terrain/ground/full_grid.hpp"
#include "terrain/ground/ground_mesh.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/raster/class_raster.hpp"
#include "terrain/raster/dem_places.hpp"

namespace diurna {

namespace {

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
    const ClassRaster raster = read_class_raster(scene.terrain.land_cover->file, scene.confines);
    const auto classes = classes_at(raster, geodetic_places(dem, middle, height));
    for (std::size_t t = 0; t < found.size(); ++t) {
        const auto entry = scene.terrain.land_cover->material.find(classes[t]);
        if (entry != scene.terrain.land_cover->material.end()) {
            found[t] = scene.materials.find(entry->second);
        }
    }
    return found;
}

/// The network the scene asks for: the full grid, or what the tolerance leaves of it.
GroundMesh ground_of(const Scene& scene, const Dem& dem, const World& world,
                     const std::vector<Footprint>& footprints) {
    using Mesh = TerrainInput::Mesh;
    const TerrainInput& terrain = scene.terrain;
    const std::size_t triangles = 2 * std::size_t(dem.columns - 1) * std::size_t(dem.rows - 1);
    if (terrain.mesh == Mesh::grid || (terrain.mesh == Mesh::grid_where_it_fits &&
                                       triangles <= TerrainInput::most_grid_triangles)) {
        return ground_mesh(dem, full_grid(dem), terrain.tolerance, footprints);
    }
    return ground_mesh(dem, terrain.tolerance, footprints, slack_of(scene, dem, world));
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

/// How far the earth falls away [m] under a place of the raster, from the plane through the site.
double earth_drop(const Eigen::Vector2d& from_site, const Eigen::Vector2d& spacing) {
    return from_site.cwiseProduct(spacing).squaredNorm() / (2e3 * earth_radius_km);
}

/// The mesh of the ground as it lies on the round earth: long triangles of level ground would be
/// chords below it, 40 m deep under 30 km of plain. A tolerance of zero asks for flat rasters as
/// they are.
GroundMesh mesh_on_round_earth(World& world, const Scene& scene, const Dem& dem,
                               const std::vector<Footprint>& cuts) {
    if (scene.terrain.tolerance <= 0.0) {
        GroundMesh mesh = ground_of(scene, dem, world, cuts);
        world.ground_check = check_ground_mesh(dem, mesh);
        return mesh;
    }
    const Eigen::Vector2d spacing = post_spacing(dem), middle(0.0, 0.0);
    const Eigen::Vector2d site = raster_places(dem, world.site, {&middle, 1}).front();
    Dem bent = dem;
    for (int row = 0; row < dem.rows; ++row) {
        for (int column = 0; column < dem.columns; ++column) {
            const double drop = earth_drop(Eigen::Vector2d(column, row) - site, spacing);
            bent.height[std::size_t(row) * std::size_t(dem.columns) + std::size_t(column)] -=
                static_cast<float>(drop);
        }
    }
    GroundMesh mesh = ground_of(scene, bent, world, cuts);
    world.ground_check = check_ground_mesh(bent, mesh);
    for (std::size_t v = 0; v < mesh.place.size(); ++v) {
        mesh.height[v] += static_cast<float>(earth_drop(mesh.place[v] - site, spacing));
    }
    return mesh;
}

}  // namespace

std::vector<std::vector<Eigen::Vector3d>> append_ground(World& world, const Scene& scene,
                                                        const Dem& dem,
                                                        std::span<const WalledPlan> buildings) {
    const Cuts cuts = cuts_of(scene, dem, world, buildings);
    const GroundMesh mesh = mesh_on_round_earth(world, scene, dem, cuts.footprint);
    const std::vector<Eigen::Vector3d> vertex =
        local_vertices(dem, world.site, mesh.place, mesh.height);
    const auto cover = covered(scene, dem, mesh);

    const auto material_of = [&](std::size_t t, std::int32_t cut) {
        if (cut >= 0 && !cuts.material[std::size_t(cut)].empty()) {
            return scene.materials.find(cuts.material[std::size_t(cut)]);
        }
        if (cover[t]) return *cover[t];
        const auto& [a, b, c] = mesh.triangle[t];
        const Eigen::Vector3d across = (vertex[b] - vertex[a]).cross(vertex[c] - vertex[a]);
        const double slope = degrees(std::acos(std::clamp(across.normalized().z(), -1.0, 1.0)));
        const double height = (mesh.height[a] + mesh.height[b] + mesh.height[c]) / 3.0;
        return material_by_rules(scene, slope, height);
    };
    const RingIndex owners(cuts.owned());
    std::vector<std::int32_t> cut_of(mesh.triangle.size());
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<MaterialId> materials;
    std::vector<ObjectId> objects;
    for (std::size_t t = 0; t < cut_of.size(); ++t) {
        const std::int32_t cut = cut_of[t] = cut_under(cuts, owners, mesh, t);
        const int object = cut < 0 ? 0 : cuts.object[std::size_t(cut)];
        if (object == Cuts::nothing) continue;
        triangles.push_back(mesh.triangle[t]);
        materials.push_back(material_of(t, cut));
        objects.push_back(ObjectId{static_cast<std::uint16_t>(object)});
    }
    append_facets(world.facets, vertex, triangles, materials, objects);
    world.ground_facets = world.facets.size();

    std::vector<std::vector<Eigen::Vector3d>> borders;
    for (std::size_t i = 0; i < buildings.size(); ++i) {
        const auto building = static_cast<std::int32_t>(cuts.first_building + i);
        std::vector<Eigen::Vector3d> border;
        for (const std::uint32_t v : border_of(mesh, cut_of, building)) {
            border.push_back(vertex[v]);
        }
        borders.push_back(std::move(border));
    }
    return borders;
}

std::vector<Eigen::Vector3d> raster_border(const WalledPlan& plan, const Dem& dem,
                                           const Site& site) {
    std::vector<Eigen::Vector3d> border;
    for (std::size_t i = 0; i < plan.ring.size(); ++i) {
        const Eigen::Vector2d a = plan.ring[i], side = plan.ring[(i + 1) % plan.ring.size()] - a;
        const int parts = std::max(1, static_cast<int>(std::ceil(side.norm() / plan.foot_edge)));
        for (int k = 0; k < parts; ++k) {
            const Eigen::Vector2d p = a + side * (double(k) / parts);
            const Geodetic below = to_geodetic(site, {p.x(), p.y(), 0.0});
            const double height = height_at(dem, below.latitude_deg, below.longitude_deg);
            if (std::isnan(height)) return {};
            const Geodetic on{below.latitude_deg, below.longitude_deg, height};
            border.emplace_back(p.x(), p.y(), to_local(site, on).z());
        }
    }
    return border;
}

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

}  // namespace diurna
