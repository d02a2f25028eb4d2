#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "materials/base/number_of.hpp"
#include "materials/matter/passed_light.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "scenes/job/world/some_facets.hpp"
#include "scenes/job/world/structures.hpp"

namespace diurna {

namespace {

constexpr float touch = 0.02f;                 // [m] that things may reach into one another
constexpr double large = 300.0, small = 0.05;  // [m] beyond which few things are

/// Facets of one object, nets and panes skipped.
struct Body {
    std::size_t object = 0;  // ObjectId
    std::vector<std::uint32_t> facet{};
    Eigen::AlignedBox3f box{};
    bool closed = true;                       // no sheet among them
    mutable std::unique_ptr<RayScene> own{};  // built at the first request
    mutable std::unique_ptr<FacetSet> facets{};
    const RayScene& rays(const FacetSet& all) const {
        if (!own) {
            facets = std::make_unique<FacetSet>(some_facets(all, facet));
            own = std::make_unique<RayScene>(*facets);
        }
        return *own;
    }
};

std::vector<Body> bodies_of(const Prepared& prepared) {
    const World& world = prepared.world;
    const std::vector<PassedLight> passed = passed_light(prepared.scene.materials);
    std::map<std::size_t, Body> by_object;
    for (std::size_t f = world.ground_facets; f < world.facets.size(); ++f) {
        const PassedLight& of = passed[index(world.facets.material[f])];
        if (!of.beam.empty() || of.heat > 0.0f) continue;
        Body& body = by_object[std::size_t(world.facets.object[f])];
        body.object = std::size_t(world.facets.object[f]);
        body.facet.push_back(std::uint32_t(f));
        const std::string& material =
            prepared.scene.materials[world.facets.material[f]].name;  // of scenes/job/world/sheets
        body.closed &= !material.ends_with(" (sheet)") && !material.ends_with(" (back)");
        for (const std::uint32_t v : world.facets.corner[f]) {
            body.box.extend(world.facets.vertex[v]);
        }
    }
    std::vector<Body> bodies;
    for (auto& [id, body] : by_object) bodies.push_back(std::move(body));
    return bodies;
}

/// A body's vertices and edges, drawn in by `touch`, for what may touch.
std::size_t edges_through(const Body& from, const Body& into, const FacetSet& all) {
    const Eigen::Vector3f middle = from.box.center(), half = 0.5f * from.box.sizes();
    const auto drawn_in = [&](std::uint32_t v) {
        Eigen::Vector3f p = all.vertex[v] - middle;
        for (int axis = 0; axis < 3; ++axis) {
            if (half[axis] > 2.0f * touch) p[axis] *= 1.0f - touch / half[axis];
        }
        return Eigen::Vector3f(middle + p);
    };
    std::vector<Ray> rays;
    for (const std::uint32_t f : from.facet) {
        for (std::size_t e = 0; e < 3; ++e) {
            const std::uint32_t a = all.corner[f][e], b = all.corner[f][(e + 1) % 3];
            const Eigen::Vector3f begin = drawn_in(a), way = drawn_in(b) - begin;
            Eigen::AlignedBox3f box(begin);
            box.extend(Eigen::Vector3f(begin + way));
            const float length = way.norm();
            if (length <= 0.0f || !into.box.intersects(box)) continue;
            rays.push_back({.origin = begin, .direction = way / length, .far = length});
        }
    }
    std::vector<std::uint8_t> blocked(rays.size());
    into.rays(all).occluded(rays, blocked);
    return std::size_t(std::count(blocked.begin(), blocked.end(), std::uint8_t{1}));
}

/// Whether straight above the middle of `what` a closed body is met from behind.
bool stands_inside(const Body& what, const Body& whole, const FacetSet& all) {
    if (!whole.closed || !whole.box.contains(what.box.center())) return false;
    std::array<Ray, 3> rays;
    std::array<Hit, 3> hits;
    const std::array<Eigen::Vector2f, 3> tilt{
        {{1.3e-3f, 0.7e-3f}, {-0.9e-3f, 1.1e-3f}, {0.2e-3f, -1.7e-3f}}};
    for (std::size_t i = 0; i < 3; ++i) {
        rays[i].origin = what.box.center();
        rays[i].direction = Eigen::Vector3f(tilt[i].x(), tilt[i].y(), 1.0f).normalized();
    }
    whole.rays(all).closest(rays, hits);
    int behind = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        behind += hits[i].facet != no_facet &&
                  whole.facets->normal[index(hits[i].facet)].dot(rays[i].direction) > 0.0f;
    }
    return behind >= 2;
}

std::string key_of(const Scene& scene, std::size_t id) {
    const std::size_t polygons = scene.terrain.polygons.size(),
                      buildings = scene.terrain.buildings.size();
    const std::size_t at = id - 1 - polygons;
    if (id > polygons && at < buildings) {
        return "building." + scene.terrain.buildings[at].name + ".place_m";
    }
    if (id > polygons && at - buildings < scene.terrain.objects.size()) {
        const ObjectInput& object = scene.terrain.objects[at - buildings];
        return "object." + object.name + (object.trajectory.empty() ? ".place_m" : ".trajectory");
    }
    return "shapes";
}

void warn_of_pairs(const Prepared& prepared, const std::vector<Body>& bodies,
                   std::vector<Mistake>& warnings) {
    constexpr std::size_t most_reported = 10;
    const World& world = prepared.world;
    std::vector<std::size_t> order(bodies.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return bodies[a].box.min().x() < bodies[b].box.min().x();
    });
    std::size_t found = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i + 1;
             j < order.size() && bodies[order[j]].box.min().x() < bodies[order[i]].box.max().x();
             ++j) {
            const Body* a = &bodies[order[i]];
            const Body* b = &bodies[order[j]];
            const Eigen::Vector3f common = a->box.intersection(b->box).sizes();
            if (common.minCoeff() <= 2.0f * touch) continue;
            if (a->object > b->object) std::swap(a, b);
            const auto names = [&](const Body& one) { return world.objects[one.object]; };
            std::string problem;
            const Body* at = b;  // the later is reported of
            if (edges_through(*a, *b, world.facets) + edges_through(*b, *a, world.facets) > 0) {
                problem = fmt::format("intersects \"{}\"", names(*a));
            } else if (stands_inside(*b, *a, world.facets)) {
                problem = fmt::format("is inside \"{}\", without sun and sky", names(*a));
            } else if (stands_inside(*a, *b, world.facets)) {
                at = a;
                problem = fmt::format("is inside \"{}\", without sun and sky", names(*b));
            }
            if (problem.empty() || ++found > most_reported) continue;
            const std::string key = key_of(prepared.scene, at->object);
            warnings.push_back(
                {prepared.scene.file.string() + ": " + key, problem,
                 "move one of them" + std::string(key.ends_with("place_m") ? " (place_m)" : "")});
        }
    }
    if (found > most_reported) {
        warnings.push_back(
            {prepared.scene.file.string(),
             fmt::format("{}", number_of(found - most_reported, "more pair of objects intersects",
                                         "more pairs of objects intersect")),
             ""});
    }
}

/// How high the lowest vertices of a body are above what is below them [m]; negative: below the
/// ground.
struct ObjectStand {
    double highest = 1e30, deepest = 0.0;  // least gap, most depth
};
std::optional<ObjectStand> stand_of(const Body& body, const Prepared& prepared) {
    const World& world = prepared.world;
    std::vector<Eigen::Vector3f> foot;
    const float level = body.box.min().z() + std::max(0.02f, 0.05f * float(body.box.sizes().z()));
    for (const std::uint32_t f : body.facet) {
        for (const std::uint32_t v : world.facets.corner[f]) {
            const Eigen::Vector3f& p = world.facets.vertex[v];
            if (p.z() <= level) foot.push_back(p);
        }
    }
    if (foot.empty()) return std::nullopt;
    const std::size_t step = (foot.size() + 63) / 64;
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < foot.size(); i += step) {
        // A little aside of the vertex, towards the middle, and from below the body or above it.
        Eigen::Vector3f p = foot[i] + 0.01f * (body.box.center() - foot[i]);
        p.z() = foot[i].z();
        rays.push_back({.origin = p, .near = 1e-3f, .direction = -Eigen::Vector3f::UnitZ()});
        rays.push_back({.origin = p, .near = 1e-3f, .direction = Eigen::Vector3f::UnitZ()});
    }
    std::vector<Hit> hits(rays.size());
    prepared.rays.closest(rays, hits);
    ObjectStand stand;
    const auto ground = [&](const Hit& hit) {
        return hit.facet != no_facet && index(hit.facet) < world.ground_facets;
    };
    for (std::size_t i = 0; i < hits.size(); i += 2) {
        double gap = 0.0;
        if (ground(hits[i + 1])) {
            gap = -double(hits[i + 1].range);
        } else if (hits[i].facet != no_facet) {
            gap = double(hits[i].range);
        }
        stand.highest = std::min(stand.highest, gap);
        stand.deepest = std::max(stand.deepest, -gap);
    }
    return stand;
}

void warn_of_stands(const Prepared& prepared, const std::vector<Body>& bodies,
                    std::vector<Mistake>& warnings) {
    const Scene& scene = prepared.scene;
    for (const Body& body : bodies) {
        if (body.object >= prepared.world.objects.size()) continue;
        for (std::size_t o = 0; o < scene.terrain.objects.size(); ++o) {
            const ObjectInput& object = scene.terrain.objects[o];
            if (std::size_t(object_id(scene, o)) != body.object || object.airspeed > 0.0) continue;
            const std::optional<ObjectStand> stand = stand_of(body, prepared);
            if (!stand) continue;
            const double height = body.box.sizes().z();
            const std::string where =
                fmt::format("{}: object.{}", scene.file.string(), object.name);
            const bool goes = !object.trajectory.empty();
            // Sheets hang or stand on posts that nobody models.
            if (!goes && body.closed && stand->highest > std::max(0.5, height)) {
                warnings.push_back(
                    {where,
                     fmt::format("floats {:.1f} m above the surface below it, more than "
                                 "its own height of {:.1f} m",
                                 stand->highest, height),
                     "height_above_ground_m = 0 places it on the ground; "
                     "airspeed_m_s declares that it flies"});
            } else if (stand->deepest > std::max(0.3, 0.5 * height) &&
                       (object.stands.over != HeightOver::ground || object.stands.metres < 0.0)) {
                // Of all others stand_warnings() says how deep they are, and how high.
                warnings.push_back(
                    {where,
                     fmt::format("is sunk {:.1f} m into the ground; its height is {:.1f} m",
                                 stand->deepest, height),
                     "height_above_ground_m raises it; on a steep slope choose another place_m"});
            }
        }
    }
}

void warn_of_sizes(const Prepared& prepared, const std::vector<Body>& bodies,
                   std::vector<Mistake>& warnings) {
    const Scene& scene = prepared.scene;
    Eigen::AlignedBox3f ground;
    for (std::size_t f = 0; f < prepared.world.ground_facets; ++f) {
        ground.extend(prepared.world.facets.centroid[f]);
    }
    const double extent = ground.isEmpty() ? 0.0 : double(ground.sizes().head<2>().minCoeff());
    for (const Body& body : bodies) {
        for (std::size_t o = 0; o < scene.terrain.objects.size(); ++o) {
            const ObjectInput& object = scene.terrain.objects[o];
            if (std::size_t(object_id(scene, o)) != body.object) continue;
            const double size = body.box.sizes().maxCoeff();
            const std::string where =
                fmt::format("{}: object.{}", scene.file.string(), object.name);
            const std::string mend =
                "set object.unit to the unit of the mesh (m, cm, mm, in, ft), or use scale";
            if (size > large || (size > 20.0 && size > 0.5 * extent)) {
                warnings.push_back(
                    {where,
                     fmt::format("has a size of {:.0f} m in a scene of {:.0f} m", size, extent),
                     mend});
            } else if (size < small) {
                warnings.push_back({where, fmt::format("has a size of {:.2g} m", size), mend});
            }
        }
    }
}

/// What the files of meshes may have wrong; of copies once.
void warn_of_meshes(const Scene& scene, std::vector<Mistake>& warnings) {
    std::set<const MeshFile*> seen;
    for (const ObjectInput& object : scene.terrain.objects) {
        if (!seen.insert(object.mesh.get()).second) continue;
        const std::string where =
            fmt::format("{}: object.{}", scene.file.string(),
                        object.copy_of.empty() ? object.name : object.copy_of);
        for (const std::string& warning : object.mesh->warnings) {
            warnings.push_back({where,
                                fmt::format("{}: {}", object.file.filename().string(), warning),
                                "repair the mesh unless this is intended"});
        }
    }
}

}  // namespace

std::vector<Mistake> object_warnings(const Prepared& prepared) {
    const std::vector<Body> bodies = bodies_of(prepared);
    std::vector<Mistake> warnings;
    warn_of_sizes(prepared, bodies, warnings);
    warn_of_pairs(prepared, bodies, warnings);
    warn_of_stands(prepared, bodies, warnings);
    warn_of_meshes(prepared.scene, warnings);
    return warnings;
}

}  // namespace diurna
