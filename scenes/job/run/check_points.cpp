#include "scenes/job/run/check_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "materials/base/random.hpp"
#include "materials/matter/passed_light.hpp"
#include "render/view/pixel_rays.hpp"
#include "scenes/job/plan/heat_bands.hpp"
#include "scenes/job/run/sun_on_surfaces.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/relief/smooth_normals.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/two_sides.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "thermal/solve/shadow_edges.hpp"

namespace diurna {

namespace {

constexpr int draws_per_point = 8;     // at most, for one that shows a facet
constexpr double patch_m = 0.05;       // [m] across
constexpr double most_of_facet = 0.1;  // of a facet's edges
// [m] above the facet, and per metre of its place, whose last digit is half of that.
constexpr float lift = 1e-3f, lift_of_place = 2.5e-7f;

/// Surfaces that lie in a place that a ray has met.
SurfaceId surface_at(const TextureLevels& levels, FacetId facet, const Eigen::Vector3d& place,
                     double drawn) {
    if (levels.empty()) return own_surface(facet);
    const Blend blend = levels.at(facet, place);
    return drawn < double{blend.second_share} ? blend.second : blend.first;
}

/// (solid facet) 1 where heat comes from other facets: along a target's sheets, and from the other
/// side of any sheet; and where an object moves along a trajectory.
std::vector<std::uint8_t> not_alone(const World& world, std::span<const NetworkObject> network) {
    std::vector<std::uint8_t> carries(world.facets.size(), 0);
    const auto mark = [&](std::uint32_t f) {
        if (f == no_number) return;
        carries[index(world.texture_levels.facet_of(SurfaceId{f}))] = 1;
    };
    for (const NetworkObject& object : network) {
        std::for_each(object.facet.begin(), object.facet.end(), mark);
        std::for_each(object.back.begin(), object.back.end(), mark);
    }
    const std::vector<std::uint32_t> other = other_sides(world.facets);
    for (std::size_t f = 0; f < other.size(); ++f) {
        if (other[f] != index(no_facet)) carries[f] = 1;
    }
    for (const Mover& mover : world.movers) {
        for (std::size_t f = 0; f < carries.size(); ++f) {
            if (world.facets.object[f] == mover.id) carries[f] = 1;
        }
    }
    return carries;
}

/// Of a point's patch in its facet's edges.
float patch_scale(const FacetSet& surfaces, SurfaceId surface) {
    const double across = std::sqrt(2.0 * double{surfaces.area[index(surface)]});
    return static_cast<float>(std::min(most_of_facet, patch_m / across));
}

/// Points on ground get the normal of the smooth surface that the mesh describes.
void set_smooth_normals(const World& world, const std::vector<CheckPoint>& points,
                        FacetSet& patches) {
    std::vector<PlaceOnFacet> places;
    std::vector<std::size_t> of;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t solid = index(world.texture_levels.facet_of(points[k].surface));
        if (solid >= world.ground_facets) continue;
        places.push_back({static_cast<std::uint32_t>(solid), points[k].place});
        of.push_back(k);
    }
    const std::vector<Eigen::Vector3f> normals =
        smooth_normals(world.facets, world.ground_facets, places);
    for (std::size_t k = 0; k < of.size(); ++k) patches.normal[of[k]] = normals[k];
}

/// A likeness of a facet about a place on it, a little above it.
void add_patch(const FacetSet& surfaces, const CheckPoint& point, float scale, FacetSet& patches) {
    const std::size_t f = index(point.surface);
    const auto& corner = surfaces.corner[f];
    const Eigen::Vector3f up =
        (lift + lift_of_place * point.place.cwiseAbs().maxCoeff()) * surfaces.normal[f];
    const auto first = static_cast<std::uint32_t>(patches.vertex.size());
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (const std::uint32_t v : corner) {
        patches.vertex.push_back(point.place + scale * (surfaces.vertex[v] - point.place) + up);
        middle += patches.vertex.back() / 3.0f;
    }
    patches.corner.push_back({first, first + 1, first + 2});
    patches.centroid.push_back(middle);
    patches.normal.push_back(surfaces.normal[f]);
    patches.area.push_back(scale * scale * surfaces.area[f]);
    patches.material.push_back(surfaces.material[f]);
    patches.object.push_back(surfaces.object[f]);
}

/// Observers with pictures of heat.
std::vector<std::uint32_t> looking_at_heat(const Prepared& prepared) {
    std::vector<std::uint32_t> looking;
    for (std::uint32_t o = 0; o < prepared.sequences.size(); ++o) {
        if (prepared.sequences[o].frame.empty()) continue;
        if (!heat_bands(prepared.scene, prepared.scene.observers[o]).empty()) looking.push_back(o);
    }
    return looking;
}

FacetViews seen_from(const FacetSet& patches, const Prepared& prepared, bool sunlight) {
    const World& world = prepared.world;
    FacetViews views = patch_views(patches, world.facets, prepared.rays,
                                   {.first_object = world.ground_facets,
                                    .object_rays = CheckPoints::rays,
                                    .seed = prepared.scene.seed,
                                    .sunlight = sunlight});
    if (!views.copied.row.empty()) {  // as reciprocity.hpp adds it
        ViewFactors both;
        both.row.push_back(0);
        for (std::size_t f = 0; f < patches.size(); ++f) {
            for (const ViewFactors* from : {&views.others, &views.copied}) {
                for (std::uint32_t k = from->row[f]; k < from->row[f + 1]; ++k) {
                    both.facet.push_back(from->facet[k]);
                    both.factor.push_back(from->factor[k]);
                }
            }
            both.row.push_back(static_cast<std::uint32_t>(both.facet.size()));
        }
        views.others = std::move(both);
        views.copied = {};
    }
    if (!world.texture_levels.empty()) {
        views.others = levels_seen(world.texture_levels, views.others);
    }
    return views;
}

}  // namespace

CheckPoints check_points(const Stages& stages, std::span<const NetworkObject> network, int count) {
    const Prepared& prepared = stages.scene();
    const World& world = prepared.world;
    const std::vector<std::uint8_t> carries = not_alone(world, network);
    CheckPoints points;
    const std::vector<std::uint32_t> looking = looking_at_heat(prepared);
    for (std::size_t l = 0; l < looking.size(); ++l) {
        const std::uint32_t o = looking[l];
        const Sequence& sequence = prepared.sequences[o];
        // As many of each observer, one more of the first ones.
        const int wanted =
            static_cast<int>((std::size_t(count) + looking.size() - 1 - l) / looking.size());
        RandomStream random{hashed(prepared.scene.seed) + o};
        const double x = random(), y = random();
        const std::size_t first = points.point.size();
        int found = 0, k = 0;
        for (; k < draws_per_point * wanted && found < wanted; ++k) {
            const auto frame = std::size_t(random() * double(sequence.frame.size()));
            const double level = random();
            const Observer& eye = sequence.at(frame);
            const PixelRays pixels = pixel_rays(eye);
            const double column = std::fmod(x + even_step_x * k, 1.0) * eye.width;
            const double row = std::fmod(y + even_step_y * k, 1.0) * eye.height;
            const Eigen::Vector3d from = eye.position + pixels.start(column, row);
            const Eigen::Vector3d towards = pixels.towards(column, row);
            const std::array<Ray, 1> ray{
                Ray{.origin = from.cast<float>(), .direction = towards.cast<float>()}};
            std::array<Hit, 1> hit;
            const RayScene& rays = stages.at_instant(sequence.frame[frame]).prepared.rays;
            rays.closest(ray, hit);
            if (hit[0].facet == no_facet) continue;
            const std::size_t f = index(hit[0].facet);
            if (hit[0].copy != no_copy || carries[f] != 0 ||
                rays.to_follow(static_cast<std::uint32_t>(f))) {
                ++points.skipped;
                ++found;
                continue;
            }
            const Eigen::Vector3d place = from + double{hit[0].range} * towards;
            points.point.push_back({surface_at(world.texture_levels, hit[0].facet, place, level), o,
                                    place.cast<float>(), from.cast<float>()});
            ++found;
        }
        const ObserverInput& input = prepared.scene.observers[o];
        for (std::size_t p = first; p < points.point.size(); ++p) {
            points.point[p].pixels = float(input.width) * float(input.height) / float(k);
        }
    }
    const FacetSet& surfaces = world.surfaces();
    for (const bool whole : {false, true}) {
        for (const CheckPoint& point : points.point) {
            const float scale = whole ? 1.0f : patch_scale(surfaces, point.surface);
            add_patch(surfaces, point, scale, points.patch);
            points.like.push_back(number(point.surface));
        }
    }
    set_smooth_normals(world, points.point, points.patch);
    return points;
}

BesideFacets patches_at(const CheckPoints& points, const Prepared& prepared) {
    BesideFacets beside{.facets = points.patch, .views = {}, .like = points.like};
    if (points.point.empty()) return beside;
    beside.views = seen_from(points.patch, prepared, false);
    if (passes_by_spectrum(passed_light(prepared.scene.materials))) {
        beside.sunlight_views = seen_from(points.patch, prepared, true);
    }
    return beside;
}

SunExposure sun_at(const CheckPoints& points, const Prepared& prepared,
                   const std::vector<Instant>& instants) {
    const FacetSet& patches = points.patch;
    const SunFractionOptions options{.samples = CheckPoints::sun_samples,
                                     .seed = prepared.scene.seed};
    const auto towards = [&](Instant when) { return sun_direction(sun_over(prepared, when)); };
    SunExposure sun{.instant = instants, .fraction = {}};
    sun.fraction.assign(instants.size() * patches.size(), 0.0f);
    for (std::size_t i = 0; i < instants.size(); ++i) {
        sun_fraction(patches, prepared.rays, towards(instants[i]),
                     std::span(sun.fraction).subspan(i * patches.size(), patches.size()), options);
    }
    find_edges(sun,
               [&](Instant when, std::span<const std::uint32_t> chosen, std::span<float> fraction) {
                   sun_fraction(patches, prepared.rays, towards(when), chosen, fraction, options);
               },
               {.tolerance = 5.0});
    return sun;
}

}  // namespace diurna
