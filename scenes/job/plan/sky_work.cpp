#include "scenes/job/plan/sky_work.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "scenes/job/plan/network_facets.hpp"
#include "terrain/visibility/ground_rays.hpp"
#include "terrain/visibility/object_boxes.hpp"

namespace diurna {

namespace {

constexpr double boxes_looked_at = 4e6;  // from all places together
constexpr std::size_t least_places = 128, most_places = 2048;
constexpr double of_box = 0.6;           // what an object fills of its box's outline
constexpr double close_by = 0.2;         // of the sky, hidden from close ground
constexpr double sees_an_object = 1e-3;  // of the sky, hidden (relief_visibility.hpp)
// Of an object's facets those that one of the ground sees.
constexpr double of_object_seen = 0.4;

/// Of the sky above a level facet, what lies below a skyline.
double below_skyline(const OpenAbove& skyline) {
    double sum = 0.0;
    for (const float tangent : skyline) {
        const double square = double{tangent} * double{tangent};
        sum += square / (1.0 + square);
    }
    return sum / double(skyline.size());
}

/// Facets met by so many rays, of so many that may be met.
double different(double hits, double facets) {
    return hits > 0.0 ? hits / (1.0 + hits / facets) : 0.0;
}

/// Facets met by so many rays of an object's facet: 69 of 256 rays, 320 of 4096 (measured on
/// vehicles and halls).
double seen_by_object(double rays) { return 3.3 * std::pow(rays, 0.55); }

/// Of entries sampled by objects' facets with so many rays, those that are left once the pairs
/// below the cut-off of reciprocity.hpp are drawn from.
double left_of_entries(double rays) { return 1.3 * std::min(1.0, std::pow(256.0 / rays, 0.35)); }

/// Facets of a usual object.
double facets_of_object(const World& world) {
    const std::size_t begin = world.ground_facets, all = world.facets.size();
    std::size_t objects = 0;
    for (std::size_t f = begin; f < all; ++f) {
        objects += f == begin || world.facets.object[f] != world.facets.object[f - 1];
    }
    return double(all - begin) / double(std::max<std::size_t>(1, objects));
}

}  // namespace

SkyWork sky_work(const Scene& scene, const World& world) {
    const double networks = double(network_facets(scene, world));
    const double objects = double(world.facets.size() - world.ground_facets);
    SkyWork work{.network_rays = networks * scene.object_sky_rays,
                 .wall_rays = std::max(0.0, objects - networks) * scene.object_sky_rays};
    work.sampled = objects * seen_by_object(scene.object_sky_rays);
    const ObjectBoxes boxes(world.facets, world.ground_facets, world.copies);
    if (boxes.empty() || world.ground_facets == 0) {
        work.ground_rays = double(world.ground_facets) * scene.sky_rays;
        return work;
    }
    const double visible = of_object_seen * facets_of_object(world);
    std::vector<std::uint32_t> all(boxes.size());
    std::iota(all.begin(), all.end(), 0u);
    const std::size_t places =
        std::min(world.ground_facets,
                 std::clamp(static_cast<std::size_t>(boxes_looked_at / double(boxes.size())),
                            least_places, most_places));
    const double each = double(world.ground_facets) / double(places);
    for (std::size_t k = 0; k < places; ++k) {
        const std::size_t f = k * world.ground_facets / places;
        OpenAbove skyline{};
        boxes.raise(box_around(world.facets, f), all, skyline);
        const double below = below_skyline(skyline), hidden = of_box * below;
        int rays = scene.sky_rays;
        if (below > sees_an_object) {
            rays = rays_near_objects(scene.sky_rays, hidden, world.facets.area[f]);
        }
        if (hidden > close_by) work.close_ground += each;
        work.ground_rays += each * rays;
        work.ground_hits += each * rays * hidden;
        work.sampled += each * different(rays * hidden, visible);
    }
    work.entries = left_of_entries(scene.object_sky_rays) * work.sampled;
    return work;
}

}  // namespace diurna
