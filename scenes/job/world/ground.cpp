#include "scenes/job/world/ground.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "materials/air/sight_line.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/world/viewpoints.hpp"
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

/// Notes classes of a table that are nowhere on the ground.
void note_unused_classes(const LandCoverInput& cover, const std::vector<std::int32_t>& classes,
                         std::vector<std::string>& notes) {
    const std::set<std::int32_t> found(classes.begin(), classes.end());
    std::string unused;
    for (const auto& [number, material] : cover.material) {
        if (!found.contains(number))
            unused += (unused.empty() ? "" : ", ") + std::to_string(number);
    }
    if (unused.empty()) return;
    notes.push_back(fmt::format("{}: classes of its table that are not on the ground: {}",
                                cover.file.string(), unused));
}

/// The material at each triangle's middle of the first land cover that knows one there.
std::vector<std::optional<MaterialId>> covered(const Scene& scene, const Dem& dem,
                                               const GroundMesh& mesh,
                                               std::vector<std::string>& notes) {
    std::vector<std::optional<MaterialId>> found(mesh.triangle.size());
    if (scene.terrain.land_cover.empty()) return found;
    std::vector<Eigen::Vector2d> middle;
    std::vector<float> height;
    for (const auto& [a, b, c] : mesh.triangle) {
        middle.push_back((mesh.place[a] + mesh.place[b] + mesh.place[c]) / 3.0);
        height.push_back(mesh.height[a]);
    }
    const std::vector<Geodetic> place = geodetic_places(dem, middle, height);
    for (const LandCoverInput& cover : scene.terrain.land_cover) {
        const auto classes = classes_at(read_class_raster(cover.file, scene.confines), place);
        note_unused_classes(cover, classes, notes);
        for (std::size_t t = 0; t < found.size(); ++t) {
            const auto entry = cover.material.find(classes[t]);
            if (!found[t] && entry != cover.material.end()) {
                found[t] = scene.materials.find(entry->second);
            }
        }
    }
    return found;
}

/// The network the scene asks for: the full grid, or what the tolerance leaves of it.
GroundMesh ground_of(const Scene& scene, const Dem& dem, const World& world,
                     const std::vector<Footprint>& footprints) {
    using Mesh = TerrainInput::Mesh;
    const TerrainInput& terrain = scene.terrain;
    std::vector<const Dem*> rasters{&dem};
    for (const DemDetail& detail : dem.detail) rasters.push_back(&detail.raster);
    std::size_t triangles = 0;
    for (const Dem* one : rasters) {
        triangles += 2 * std::size_t(one->columns - 1) * std::size_t(one->rows - 1);
    }
    if (terrain.mesh == Mesh::grid || (terrain.mesh == Mesh::grid_where_it_fits &&
                                       triangles <= TerrainInput::most_grid_triangles)) {
        std::vector<Tin> grids;
        for (const Dem* one : rasters) grids.push_back(full_grid(*one));
        return ground_mesh(dem, grids.front(), terrain.elevation.tolerance, footprints, {},
                           std::span(grids).subspan(1));
    }
    return ground_mesh(dem, terrain.elevation.tolerance, footprints, slack_of(scene, dem, world));
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
    if (scene.terrain.elevation.tolerance <= 0.0) {
        GroundMesh mesh = ground_of(scene, dem, world, cuts);
        world.ground_check = check_ground_mesh(dem, mesh);
        return mesh;
    }
    const Eigen::Vector2d spacing = post_spacing(dem), middle(0.0, 0.0);
    const Eigen::Vector2d site = raster_places(dem, world.site, {&middle, 1}).front();
    Dem bent = dem;
    const auto bend = [&](Dem& raster, const auto& to_coarse) {
        for (int row = 0; row < raster.rows; ++row) {
            for (int column = 0; column < raster.columns; ++column) {
                const Eigen::Vector2d at = to_coarse(Eigen::Vector2d(column, row));
                raster
                    .height[std::size_t(row) * std::size_t(raster.columns) + std::size_t(column)] -=
                    static_cast<float>(earth_drop(at - site, spacing));
            }
        }
    };
    bend(bent, [](const Eigen::Vector2d& post) { return post; });
    for (DemDetail& detail : bent.detail) bend(detail.raster, detail.to_coarse);
    GroundMesh mesh = ground_of(scene, bent, world, cuts);
    world.ground_check = check_ground_mesh(bent, mesh);
    for (std::size_t v = 0; v < mesh.place.size(); ++v) {
        mesh.height[v] += static_cast<float>(earth_drop(mesh.place[v] - site, spacing));
    }
    return mesh;
}

/// A side of a triangle by its ends, as they are kept: facets have another order than triangles.
using OutlineSide = std::array<float, 6>;
OutlineSide outline_side(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return {a.x(), a.y(), a.z(), b.x(), b.y(), b.z()};
}

/// Those of a mesh that lie on the raster's outline.
std::set<OutlineSide> sides_on_outline(const Dem& dem, const GroundMesh& mesh,
                                       const std::vector<Eigen::Vector3d>& vertex) {
    constexpr double beside = 1e-6;  // of a post
    const auto on = [&](std::uint32_t v, std::size_t edge) {
        const Eigen::Vector2d& at = mesh.place[v];
        return edge == 0   ? at.x() <= beside
               : edge == 1 ? at.y() <= beside
               : edge == 2 ? at.x() >= dem.columns - 1 - beside
                           : at.y() >= dem.rows - 1 - beside;
    };
    std::set<OutlineSide> sides;
    for (const auto& corner : mesh.triangle) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = corner[k], b = corner[(k + 1) % 3];
            bool outline = false;
            for (std::size_t edge = 0; edge < 4; ++edge) outline |= on(a, edge) && on(b, edge);
            if (outline)
                sides.insert(outline_side(vertex[a].cast<float>(), vertex[b].cast<float>()));
        }
    }
    return sides;
}

/// The facets that have such sides.
std::vector<BorderFacet> border_facets(const FacetSet& facets,
                                       const std::set<OutlineSide>& outline) {
    std::set<std::array<float, 3>> ends;
    for (const OutlineSide& side : outline) ends.insert({side[0], side[1], side[2]});
    std::vector<std::uint8_t> is_end(facets.vertex.size());
    for (std::size_t v = 0; v < is_end.size(); ++v) {
        const Eigen::Vector3f& at = facets.vertex[v];
        is_end[v] = ends.contains({at.x(), at.y(), at.z()});
    }
    std::vector<BorderFacet> border;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        float length = 0.0f;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = facets.corner[f][k], b = facets.corner[f][(k + 1) % 3];
            if (!is_end[a] && !is_end[b]) continue;
            const Eigen::Vector3f &from = facets.vertex[a], &to = facets.vertex[b];
            if (outline.contains(outline_side(from, to))) length += (to - from).norm();
        }
        if (length > 0.0f) border.push_back({std::uint32_t(f), length});
    }
    return border;
}

}  // namespace

std::vector<PlanBorders> append_ground(World& world, const Scene& scene, const Dem& dem,
                                       std::span<const WalledPlan> buildings) {
    const Cuts cuts = cuts_of(scene, dem, world, buildings);
    const GroundMesh mesh = mesh_on_round_earth(world, scene, dem, cuts.footprint);
    const std::vector<Eigen::Vector3d> vertex =
        local_vertices(dem, world.site, mesh.place, mesh.height);
    const auto cover = covered(scene, dem, mesh, world.notes);

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
    const RingIndex owners(cuts.owned()), grounds(cuts.ground());
    std::vector<std::int32_t> cut_of(mesh.triangle.size());
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<MaterialId> materials;
    std::vector<ObjectId> objects;
    for (std::size_t t = 0; t < cut_of.size(); ++t) {
        const std::int32_t cut = cut_of[t] = cut_under(cuts, owners, grounds, mesh, t);
        const int object = cut < 0 ? 0 : cuts.object[std::size_t(cut)];
        if (object == Cuts::nothing) continue;
        triangles.push_back(mesh.triangle[t]);
        materials.push_back(material_of(t, cut));
        objects.push_back(ObjectId{static_cast<std::uint16_t>(object)});
    }
    append_facets(world.facets, vertex, triangles, materials, objects);
    world.ground_facets = world.facets.size();
    world.border = border_facets(world.facets, sides_on_outline(dem, mesh, vertex));

    std::vector<PlanBorders> borders;
    for (std::size_t i = 0; i < buildings.size(); ++i) {
        PlanBorders& of_plan = borders.emplace_back();
        for (const auto& line : borders_of(mesh, cut_of, cuts.of_plan[i])) {
            auto& border = of_plan.emplace_back();
            for (const std::uint32_t v : line) border.push_back(vertex[v]);
        }
    }
    return borders;
}

std::vector<Eigen::Vector3d> raster_border(const Ring& ring, double foot_edge, const Dem& dem,
                                           const Site& site) {
    std::vector<Eigen::Vector3d> border;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d a = ring[i], side = ring[(i + 1) % ring.size()] - a;
        const int parts = std::max(1, static_cast<int>(std::ceil(side.norm() / foot_edge)));
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

}  // namespace diurna
