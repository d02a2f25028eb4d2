#include "scenes/job/world/copied_objects.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/passed_light.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/overlaps.hpp"
#include "scenes/job/world/stance.hpp"
#include "scenes/job/world/structures.hpp"
#include "scenes/job/world/surroundings.hpp"
#include "scenes/job/world/wind.hpp"

namespace diurna {

namespace {

/// The copies of one object, which stand one behind the other among the scene's.
struct CopySet {
    std::size_t first, count;
    std::vector<Eigen::Isometry3d> pose{};  // (copy) from an object at the origin that heads north
    std::uint32_t first_facet = 0, facets = 0;  // of the first copy
};

std::vector<CopySet> sets_of(const Scene& scene) {
    const std::vector<ObjectInput>& objects = scene.terrain.objects;
    std::vector<CopySet> sets;
    for (std::size_t k = 0; k < objects.size(); ++k) {
        if (objects[k].copy_of.empty()) continue;
        const bool more = !sets.empty() && sets.back().first + sets.back().count == k &&
                          objects[k - 1].copy_of == objects[k].copy_of;
        if (!more) sets.push_back({k, 0});
        ++sets.back().count;
    }
    return sets;
}

void refuse_textures(const Scene& scene, const ObjectInput& object) {
    for (const std::string& material : object.material) {
        if (scene.texture_uses.of_material.count(material) == 0) continue;
        throw InputError(object.where, fmt::format("object \"{}\" has copies and the material {}, "
                                                   "which has a texture, expected another material",
                                                   object.copy_of, material));
    }
}

/// Where an object stands, which its placing then says, too.
Eigen::Isometry3d put_down(ObjectInput& object, const Dem& dem, const World& world) {
    const std::string where = fmt::format("{}: object \"{}\"", object.where, object.name);
    const Stance stance = stance_of(object, dem, world, where);
    object.placing.base = stance.base;
    object.placing.pitch_deg = stance.pitch_deg;
    object.placing.roll_deg = stance.roll_deg;
    if (!stance.level()) return stance.pose();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translate(stance.base);
    pose.rotate(Eigen::AngleAxisd(-radians(stance.heading_deg), Eigen::Vector3d::UnitZ()));
    return pose;
}

std::uint32_t facets_of(const World& world) {
    return static_cast<std::uint32_t>(world.facets.size());
}

/// Appends a copy as an object of its own; returns how many facets it has.
std::uint32_t append_own(World& world, Scene& scene, const Dem& dem, Sheets& sheets,
                         std::size_t object) {
    const std::uint32_t before = facets_of(world);
    append_object(world, scene, dem, sheets, object);
    return facets_of(world) - before;
}

/// How the copies of a set share their facets.
struct Shared {
    std::vector<std::size_t> like;  // (copy) the copy whose facets it has; itself: its own
    std::size_t own = 0;
    double mean = 0.0, worst = 0.0;  // [K] largest estimates
};

/// Each joins the first before it that is alike.
Shared shared_among(const CopySet& set, const SurroundingsSampler& sampler,
                    const std::vector<Surroundings>& found, double within) {
    Shared shared;
    for (std::size_t c = 0; c < set.count; ++c) {
        shared.like.push_back(c);
        for (std::size_t other = 0; other < c && within > 0.0; ++other) {
            if (shared.like[other] != other) continue;
            const auto apart = sampler.apart(found[c], found[other], within);
            if (!(apart.mean <= within)) continue;
            shared.like[c] = other;
            shared.mean = std::max(shared.mean, apart.mean);
            shared.worst = std::max(shared.worst, apart.worst);
            break;
        }
        shared.own += shared.like[c] == c;
    }
    return shared;
}

std::string reported(const ObjectInput& object, const CopySet& set, const Shared& shared,
                     bool some_go) {
    if (object.alike_within == 0.0) {
        return fmt::format("copies: {} copies of '{}' have separate temperatures", set.count,
                           object.copy_of);
    }
    std::string note =
        fmt::format("copies: {} copies of '{}' share the temperatures of {} representatives",
                    set.count, object.copy_of, shared.own);
    if (shared.own == set.count) {
        return fmt::format(
            "copies: {} copies of '{}' have separate temperatures: no two have headings within "
            "{:g} degrees and differ by less than copies_alike_K = {:g}",
            set.count, object.copy_of, SurroundingsSampler::furthest_heading_deg,
            object.alike_within);
    }
    return note +
           fmt::format(
               ": estimated difference at the worst hour at most {:.2g} K in the mean over the "
               "surface (limit copies_alike_K = {:g}), {:.0f} K at single places near shadow "
               "edges; a copy receives the sunlight of its representative, except at shadow edges",
               shared.mean, object.alike_within, shared.worst) +
           (some_go ? "; moving objects were compared at the start of their trajectories" : "");
}

/// Of copies that stand in one another.
std::string overlap_note(const Scene& scene, const std::vector<CopySet>& sets,
                         const std::vector<BodyBox>& boxes) {
    constexpr double least = 0.05;  // [m] things may touch, and boxes are a little large
    const Overlaps found = overlaps(boxes, least);
    if (found.pairs == 0) return "";
    std::vector<std::string> name;
    for (const CopySet& set : sets) {
        for (std::size_t c = 0; c < set.count; ++c) {
            name.push_back(scene.terrain.objects[set.first + c].name);
        }
    }
    return fmt::format(
        "copies: the bounding boxes of {} of copies intersect; the largest overlap is \"{}\" and "
        "\"{}\", {:.2g} m",
        found.pairs == 1 ? "one pair" : fmt::format("{} pairs", found.pairs),
        name[found.worst.first], name[found.worst.second], found.deepest);
}

}  // namespace

void append_copies(World& world, Scene& scene, const Dem& dem, Sheets& sheets) {
    std::vector<CopySet> sets = sets_of(scene);
    if (sets.empty()) return;
    // First all in their places as copies of the first of their set, to see what is around each.
    std::vector<Copy> all;
    for (CopySet& set : sets) {
        ObjectInput* objects = &scene.terrain.objects[set.first];
        refuse_textures(scene, *objects);
        for (std::size_t c = 0; c < set.count; ++c) {
            set.pose.push_back(put_down(objects[c], dem, world));
        }
        set.first_facet = facets_of(world);
        set.facets = append_own(world, scene, dem, sheets, set.first);
        for (std::size_t c = 1; c < set.count; ++c) {
            all.push_back({set.first_facet, set.facets, object_id(scene, set.first + c),
                           set.pose[c] * set.pose.front().inverse()});
            refuse_buried(objects[c], in_place(world.facets, all.back()).vertex, dem, world.site);
        }
    }
    std::vector<BodyBox> boxes;
    for (const CopySet& set : sets) {
        const BodyBox box = box_round(world.facets, set.first_facet, set.facets);
        for (const Eigen::Isometry3d& pose : set.pose) {
            boxes.push_back(placed_box(box, pose * set.pose.front().inverse()));
        }
    }
    if (std::string note = overlap_note(scene, sets, boxes); !note.empty()) {
        world.notes.push_back(std::move(note));
    }
    const std::vector<float> wind = wind_at_boxes(world, boxes);
    const RayScene rays(world.facets, passed_light(scene.materials), Copies(std::move(all)));
    std::vector<Shared> shared;
    std::size_t box = 0;
    for (const CopySet& set : sets) {
        const ObjectInput* objects = &scene.terrain.objects[set.first];
        const SurroundingsSampler sampler(world, scene, set.first_facet, set.facets,
                                          stance_in(objects[0].placing));
        std::vector<Surroundings> found(set.count);
        for_each_index(
            set.count,
            [&](std::size_t c) {
                found[c] = sampler.at(rays, set.pose[c] * set.pose.front().inverse(),
                                      stance_in(objects[c].placing), wind[box + c]);
            },
            4);
        box += set.count;
        shared.push_back(shared_among(set, sampler, found, objects[0].alike_within));
        if (set.count == 1) continue;
        world.notes.push_back(reported(objects[0], set, shared.back(), !world.movers.empty()));
    }
    // Then those that are like no other with facets of their own, the others as their copies.
    std::vector<Copy> copies;
    for (std::size_t s = 0; s < sets.size(); ++s) {
        const CopySet& set = sets[s];
        std::vector<std::uint32_t> first(set.count, set.first_facet), size(set.count, set.facets);
        for (std::size_t c = 1; c < set.count; ++c) {
            const std::size_t like = shared[s].like[c];
            if (like == c) {
                first[c] = facets_of(world);
                size[c] = append_own(world, scene, dem, sheets, set.first + c);
                continue;
            }
            copies.push_back({first[like], size[like], object_id(scene, set.first + c),
                              set.pose[c] * set.pose[like].inverse()});
        }
    }
    world.copies = Copies(std::move(copies));
}

}  // namespace diurna
