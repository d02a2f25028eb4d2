#include "scenes/job/world/ground_cuts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "materials/base/error.hpp"
#include "scenes/job/world/copy_ground.hpp"
#include "scenes/job/world/ground_point.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/jets.hpp"
#include "scenes/job/world/land.hpp"
#include "scenes/job/world/movers.hpp"
#include "scenes/job/world/objects.hpp"
#include "scenes/job/world/shadow_tracks.hpp"
#include "terrain/place/trajectory.hpp"
#include "terrain/raster/dem_places.hpp"

namespace diurna {

namespace {

/// Whether any corner of a ring is on the raster.
bool lies_on(const Dem& dem, const Ring& ring) {
    return std::any_of(ring.begin(), ring.end(), [&](const Eigen::Vector2d& p) {
        return p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= dem.columns - 1 && p.y() <= dem.rows - 1;
    });
}

/// When an object's shadow falls on other ground: once in each of its rests, and each `apart` [m]
/// of its moves, 32 times at most. Whatever the span and the pictures, so that another part of the
/// day, or a picture alone, has the same ground. [s] of its trajectory
std::vector<double> when_elsewhere(const TrajectoryInput& way, double apart) {
    std::vector<double> all, on_the_way;
    for (const Rest& rest : rests(way.way, way.metres())) {
        all.push_back(std::isfinite(rest.from) ? rest.from : rest.until);
    }
    double gone = 0.0;
    const double metres = way.metres();
    for (std::size_t i = 1; i < way.way.seconds.size(); ++i) {
        const double length = metres * (way.way.place[i] - way.way.place[i - 1]).head<2>().norm();
        const double from = way.way.seconds[i - 1], step = way.way.seconds[i] - from;
        for (; gone < length && on_the_way.size() < 100000; gone += apart) {
            on_the_way.push_back(from + step * gone / length);
        }
        gone -= length;
    }
    constexpr std::size_t most = 32;
    const std::size_t count = on_the_way.size(), shown = std::min(most, count);
    for (std::size_t i = 0; i < shown; ++i) {
        all.push_back(on_the_way[shown < 2 ? 0 : i * (count - 1) / (shown - 1)]);
    }
    return all;
}

/// Where the ground is to be fine for an object's shadow, each place once. East, north [m]
std::vector<Eigen::Vector2d> shadow_places(const ObjectInput& input, const Scene& scene,
                                           const Site& site) {
    if (input.trajectory.empty()) return {input.place};
    const TrajectoryInput& way = *find_trajectory(scene.trajectories, input.trajectory);
    std::vector<Eigen::Vector2d> places;
    for (const double when : when_elsewhere(way, std::max(1.0, shadow_reach(input)))) {
        const Eigen::Vector3d at = place_at(way.way, when);
        const Eigen::Vector2d plan =
            way.geodetic
                ? Eigen::Vector2d(to_local(site, Geodetic{at.y(), at.x(), site.height}).head<2>())
                : Eigen::Vector2d(at.head<2>());
        const bool known = std::any_of(places.begin(), places.end(), [&](const auto& other) {
            return (other - plan).norm() < 0.1;
        });
        if (!known) places.push_back(plan);
    }
    return places;
}

/// Where an object, or each of some copies of it, is while it rests: middle of its plan and lowest
/// point. East, north, up [m]
std::vector<Eigen::Vector3d> resting_places(std::span<const ObjectInput> alike, const Scene& scene,
                                            const Dem& dem, const World& world) {
    std::vector<Eigen::Vector3d> places;
    for (const ObjectInput& object : alike) {
        const Eigen::Vector2d& at = object.place;
        if (object.trajectory.empty()) {
            if (!ground_if_any(dem, world.site, at)) continue;
            places.push_back(stand_point(world, dem, at, object.stands, object.where));
            continue;
        }
        const TrajectoryInput& way = *find_trajectory(scene.trajectories, object.trajectory);
        const ObjectCourse course(object, scene, dem, world);
        for (const Rest& rest : rests(way.way, way.metres())) {
            const double when = std::isfinite(rest.from) ? rest.from : rest.until;
            places.push_back(course.at(later(way.start, when)).translation());
        }
    }
    return places;
}

/// Of an object beyond the raster: only one whose height is not that above the ground may be there.
void refuse_beyond(const ObjectInput& object, const Eigen::Vector2d& place, const Scene& scene) {
    const TrajectoryInput* way = find_trajectory(scene.trajectories, object.trajectory);
    const HeightOver over = way != nullptr ? way->heights : object.stands.over;
    if (over != HeightOver::ground) return;
    throw InputError(
        way != nullptr ? way->where : object.where,
        fmt::format("\"{}\" {} east {:g} m, north {:g} m, outside the elevation data", object.name,
                    way != nullptr ? "extends to" : "is at", place.x(), place.y()),
        way != nullptr ? "set heights = \"sea\" in the trajectory, with heights above the sea"
                       : "there, set height_above_sea_m or height_above_ellipsoid_m");
}

/// Round objects, for their shadows. Throws InputError for one outside the raster.
std::vector<GroundPatch> patches_of(const Scene& scene, const Dem& dem, const World& world) {
    const Site& site = world.site;
    const SunCourses sun(site, scene.time);
    const std::span<const ObjectInput> objects = scene.terrain.objects;
    std::vector<GroundPatch> all;
    for (std::size_t k = 0; k < objects.size();) {
        const ObjectInput& object = objects[k];
        std::size_t end = k + 1;
        while (!object.copy_of.empty() && end < objects.size() &&
               objects[end].copy_of == object.copy_of) {
            ++end;
        }
        std::vector<GroundPatch> patches;
        if (object.copy_of.empty()) {
            for (const Eigen::Vector2d& place : shadow_places(object, scene, site)) {
                if (lies_on(dem, raster_places(dem, site, {&place, 1}))) {
                    patches.push_back(ground_patch(object, place));
                } else {
                    refuse_beyond(object, place, scene);
                }
            }
        } else {
            for (const ObjectInput& copy : objects.subspan(k, end - k)) {
                if (copy.stands.over != HeightOver::ground ||
                    lies_on(dem, raster_places(dem, site, {&copy.place, 1}))) {
                    continue;
                }
                throw InputError(copy.where,
                                 fmt::format("\"{}\" lies outside the elevation data", copy.name));
            }
            for (GroundPatch& patch : patches_round(objects.subspan(k, end - k))) {
                // A tile at the raster's edge may lie beyond it.
                if (lies_on(dem, raster_places(dem, site, patch.ring))) {
                    patches.push_back(std::move(patch));
                }
            }
        }
        const auto alike = objects.subspan(k, end - k);
        for (GroundPatch& patch :
             shadow_tracks(object, resting_places(alike, scene, dem, world), sun, dem, site)) {
            if (lies_on(dem, raster_places(dem, site, patch.ring))) {
                patches.push_back(std::move(patch));
            }
        }
        std::move(patches.begin(), patches.end(), std::back_inserter(all));
        k = end;
    }
    return all;
}

/// [m/m] of triangles around what is refined: neighbours differ by a factor of at most 1.3.
constexpr double edge_growth = 0.5;

/// - ring: of the patch, on the raster
Footprint refinement(const Ring& ring, const GroundPatch& patch) {
    return {.ring = ring,
            .largest_edge = patch.largest_edge,
            .owner = false,
            .border = false,
            .growth = edge_growth};
}

double area_of(const Ring& ring) {
    double twice = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * std::abs(twice);
}

/// In the order given, but if any has a courtyard the largest first: a building in the courtyard of
/// another then stands in it.
std::vector<std::size_t> outermost_first(std::span<const WalledPlan> plans) {
    std::vector<std::size_t> order(plans.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (std::all_of(plans.begin(), plans.end(), [](const auto& p) { return p.hole.empty(); })) {
        return order;
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return area_of(plans[a].ring) > area_of(plans[b].ring);
    });
    return order;
}

}  // namespace

Cuts cuts_of(const Scene& scene, const Dem& dem, const World& world,
             std::span<const WalledPlan> buildings) {
    const Site& site = world.site;
    Cuts cuts;
    for (const GroundShape& shape : ground_shapes(scene.terrain.shapes, dem, site)) {
        cuts.add(shape.footprint, shape.material, 0);
    }
    int object = 0;
    for (const GroundPolygon& polygon : scene.terrain.polygons) {
        ++object;
        const Ring ring = raster_places(dem, site, polygon.ring);
        if (clipped(ring, dem.columns, dem.rows).size() < 3) {
            throw InputError(
                polygon.where,
                fmt::format("ground \"{}\" is entirely outside the elevation data", polygon.name),
                "its corners are in metres east and north of the site");
        }
        cuts.add({.ring = ring, .largest_edge = polygon.largest_edge, .growth = edge_growth},
                 polygon.material, polygon.material.empty() ? 0 : object);
    }
    cuts.first_building = cuts.footprint.size();
    cuts.of_plan.resize(buildings.size());
    for (const std::size_t i : outermost_first(buildings)) {
        const WalledPlan& plan = buildings[i];
        cuts.of_plan[i] = static_cast<std::int32_t>(cuts.footprint.size());
        cuts.add({.ring = raster_places(dem, site, plan.ring),
                  .largest_edge = plan.foot_edge,
                  .lattice = false,
                  .growth = edge_growth},
                 "", Cuts::nothing);
        for (const Ring& court : plan.hole) {
            constexpr double most_triangles = 2000.0;
            cuts.add({.ring = raster_places(dem, site, court),
                      .largest_edge = plan.foot_edge,
                      .lattice = area_of(court) < most_triangles * std::pow(plan.foot_edge, 2),
                      .growth = edge_growth,
                      .inward = true},
                     "", Cuts::courtyard);
        }
    }
    for (const GroundPatch& patch : patches_of(scene, dem, world)) {
        cuts.footprint.push_back(refinement(raster_places(dem, site, patch.ring), patch));
    }
    for (const ObjectInput& input : scene.terrain.objects) {
        const auto ground = ground_if_any(dem, site, input.place);
        if (!input.copy_of.empty() || input.target.jet.empty() || !ground) continue;
        const double over_ground =
            stand_point(world, dem, input.place, input.stands, input.where).z() - ground->z();
        for (const GroundPatch& patch : jet_patches(input, over_ground)) {
            const Ring ring = raster_places(dem, site, patch.ring);
            if (lies_on(dem, ring)) cuts.footprint.push_back(refinement(ring, patch));
        }
    }
    return cuts;
}

std::vector<Ring> Cuts::owned() const {
    std::vector<Ring> rings;
    for (std::size_t f = 0; f < object.size(); ++f) rings.push_back(footprint[f].ring);
    return rings;
}

std::vector<Ring> Cuts::ground() const {
    std::vector<Ring> rings;
    for (std::size_t f = 0; f < first_building; ++f) rings.push_back(footprint[f].ring);
    return rings;
}

std::int32_t cut_under(const Cuts& cuts, const RingIndex& owners, const RingIndex& ground,
                       const GroundMesh& mesh, std::size_t triangle) {
    std::int32_t f = mesh.footprint[triangle];
    const auto& [a, b, c] = mesh.triangle[triangle];
    const Eigen::Vector2d middle = (mesh.place[a] + mesh.place[b] + mesh.place[c]) / 3.0;
    if (f >= 0 && cuts.is_patch(f)) f = owners.last_around(middle);
    const bool court = f >= 0 && cuts.object[std::size_t(f)] == Cuts::courtyard;
    return court ? ground.last_around(middle) : f;
}

std::vector<std::vector<std::uint32_t>> borders_of(const GroundMesh& mesh,
                                                   std::span<const std::int32_t> cut_of,
                                                   std::int32_t cut) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t t = 0; t < cut_of.size(); ++t) {
        if (cut_of[t] != cut) continue;
        const auto& corner = mesh.triangle[t];
        for (std::size_t k = 0; k < 3; ++k) edges.emplace(corner[k], corner[(k + 1) % 3]);
    }
    std::map<std::uint32_t, std::uint32_t> next;
    for (const auto& [a, b] : edges) {
        if (edges.count({b, a})) continue;
        if (!next.try_emplace(a, b).second) return {};
    }
    std::vector<std::vector<std::uint32_t>> borders;
    while (!next.empty()) {
        std::vector<std::uint32_t>& border = borders.emplace_back();
        for (auto at = next.begin(); at != next.end();) {
            border.push_back(at->first);
            const std::uint32_t after = at->second;
            next.erase(at);
            if (after == border.front()) break;
            at = next.find(after);
            if (at == next.end()) return {};
        }
    }
    return borders;
}

}  // namespace diurna
