#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "render/path/direction_angles.hpp"
#include "render/view/pixel_rays.hpp"
#include "scenes/job/plan/target_sight.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "scenes/job/world/border_ground.hpp"
#include "scenes/job/world/heights.hpp"

namespace diurna {

namespace {

constexpr int grid = 24;                // rays each way over a picture
constexpr std::size_t poses = 8;        // of those that go, evenly
constexpr float right_before = 0.5;     // [m]
constexpr double well_below_deg = 1.0;  // nearer the level every raster ends

struct Seen {
    std::size_t rays = 0, sky = 0, near = 0;
    std::size_t beyond = 0;                  // that meet ground beyond the raster
    std::size_t below = 0, well_beyond = 0;  // a degree below the level; of these beyond
    float furthest = 0.0f;
    std::uint32_t facet = 0;  // of the furthest
};

/// - border: none: of a scene without ground
Seen seen_by(const Observer& observer, const RayScene& scene, const World& world,
             const std::optional<BorderGround>& border) {
    const PixelRays pixels = pixel_rays(observer);
    std::vector<Ray> rays;
    for (int row = 0; row < grid; ++row) {
        for (int column = 0; column < grid; ++column) {
            const double x = (column + 0.5) / grid * observer.width,
                         y = (row + 0.5) / grid * observer.height;
            rays.push_back({.origin = (observer.position + pixels.start(x, y)).cast<float>(),
                            .direction = pixels.towards(x, y).cast<float>()});
        }
    }
    std::vector<Hit> hits(rays.size());
    scene.closest(rays, hits);
    Seen seen{.rays = rays.size()};
    const double eye = height_above_sea(world, observer.position);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const Hit& hit = hits[i];
        const double zenith_deg = zenith_deg_of(rays[i].direction.cast<double>());
        const bool well_below = zenith_deg > 90.0 + well_below_deg;
        seen.below += well_below;
        if (hit.facet == no_facet) {
            ++seen.sky;
            const bool beyond = border && looks_below_horizon(eye, border->height, zenith_deg);
            seen.beyond += beyond;
            seen.well_beyond += beyond && well_below;
            continue;
        }
        seen.near += hit.range < right_before;
        if (hit.range > seen.furthest) {
            seen.furthest = hit.range;
            seen.facet = static_cast<std::uint32_t>(hit.facet);
        }
    }
    return seen;
}

/// The object that an observer is to see and that stands; "": none.
std::string target_of(const Prepared& prepared, const ObserverInput& input) {
    const std::string target = input.around ? input.around->object : input.look_at_object;
    for (const Mover& mover : prepared.world.movers) {
        if (prepared.scene.terrain.objects[mover.object].name == target) return "";
    }
    return target;
}

/// Of an observer whose target is hidden from all of its places that were tried.
void warn_of_target(const Prepared& prepared, std::size_t o, std::vector<Mistake>& warnings) {
    const ObserverInput& input = prepared.scene.observers[o];
    const std::string target = target_of(prepared, input);
    const std::vector<Observer>& pose = prepared.sequences[o].pose;
    if (target.empty() || pose.empty()) return;
    TargetSight best;
    double most = -1.0;
    for (std::size_t p = 0; p < pose.size(); p += (pose.size() + poses - 1) / poses) {
        const TargetSight sight = target_sight(prepared.world, prepared.rays, pose[p], target);
        if (sight.share() <= most) continue;
        most = sight.share();
        best = sight;
    }
    if (most >= hidden_below) return;
    const std::string problem =
        best.seen == 0
            ? fmt::format("does not see \"{}\": \"{}\" hides it", target, best.hidden_by)
            : fmt::format(
                  "sees {:.0f} % of the surfaces of \"{}\" that face it: \"{}\" hides the others",
                  std::ceil(100.0 * most), target, best.hidden_by);
    warnings.push_back(
        {fmt::format("{}: observer.{}", prepared.scene.file.string(), input.name), problem,
         input.around ? "change aspect_deg, increase elevation_deg or reduce range_m of around; "
                        "if_hidden = \"draw_again\" draws another aspect"
                      : "move place_m, or raise height_above_ground_m"});
}

}  // namespace

std::vector<Mistake> view_warnings(const Prepared& prepared) {
    constexpr double least_beyond = 0.01;  // of what looks down
    std::vector<Mistake> warnings;
    const std::optional<BorderGround> border = border_ground(prepared.world, prepared.world.facets);
    for (std::size_t o = 0; o < prepared.sequences.size(); ++o) {
        const Sequence& sequence = prepared.sequences[o];
        const std::size_t step = (sequence.pose.size() + poses - 1) / poses;
        std::size_t looked = 0, sky = 0, near = 0;
        float furthest = 0.0f;
        double beyond = 0.0, of_ground = 0.0;
        std::uint32_t facet = 0;
        const Observer* first = nullptr;
        for (std::size_t p = 0; p < sequence.pose.size(); p += step) {
            const Seen seen = seen_by(sequence.pose[p], prepared.rays, prepared.world, border);
            beyond = std::max(beyond, double(seen.beyond) / double(seen.rays));
            of_ground =
                std::max(of_ground, double(seen.well_beyond) / std::max(1.0, double(seen.below)));
            ++looked;
            sky += seen.sky == seen.rays;
            near += seen.near == seen.rays;
            if (first == nullptr) first = &sequence.pose[p];
            if (seen.furthest > furthest) {
                furthest = seen.furthest;
                facet = seen.facet;
            }
        }
        if (looked == 0) continue;
        warn_of_target(prepared, o, warnings);
        const std::string where =
            fmt::format("{}: observer.{}", prepared.scene.file.string(), first->name);
        if (border && of_ground >= least_beyond) {
            const std::string& material = prepared.scene.materials[border->material].kind();
            warnings.push_back(
                {where,
                 fmt::format("{:.0f} % of its picture{} is ground beyond the elevation raster "
                             "(the part that is read), modelled to the horizon as {} at {:.0f} m "
                             "above the sea, with the "
                             "temperature at the raster's edge, without relief, labels or objects",
                             std::ceil(100.0 * beyond), looked > 1 ? " (at most)" : "", material,
                             border->height),
                 "use a larger raster (terrain.elevation, terrain.radius_m) or a nearer camera"});
        }
        if (sky == looked) {
            warnings.push_back(
                {where,
                 fmt::format("sees nothing {} (it looks to {:.0f} degrees from north, {:.1f} above "
                             "the horizon)",
                             beyond > 0.0 ? "of the elevation raster" : "but sky",
                             std::fmod(first->azimuth_deg + 360.0, 360.0), first->elevation_deg),
                 "a negative elevation_deg looks down; look_at = \"NAME\" or look_at_m points the "
                 "camera"});
        } else if (near == looked) {
            const FacetSet& facets = prepared.world.facets;
            const auto object = std::size_t(facets.object[facet]);
            warnings.push_back(
                {where,
                 fmt::format(
                     "sees nothing beyond {:.2g} m: \"{}\" is directly in front of its lens",
                     furthest, prepared.world.objects[object]),
                 "move place_m, height_above_ground_m or mount_m"});
        }
    }
    return warnings;
}

}  // namespace diurna
