#include "scenes/job/plan/drawn_aspect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "materials/base/error.hpp"
#include "materials/base/random.hpp"
#include "scenes/job/plan/aspect_place.hpp"
#include "scenes/job/plan/target_sight.hpp"

namespace diurna {

namespace {

constexpr int aspect_draws = 32, level_draws = 16;
constexpr double highest_draw_deg = 80.0;

/// The share of its target that a camera sees; none where its eye cannot be.
std::optional<double> seen_from(const Observer& observer, const Around& around, const World& world,
                                const RayScene& rays, const EyeCheck& check,
                                const MoverPoses& poses) {
    try {
        check.check(observer, poses);
    } catch (const InputError&) {
        return std::nullopt;
    }
    return target_sight(world, rays, observer, around.object).share();
}

/// FNV-1a.
std::uint64_t name_hash(const std::string& text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return hash;
}

}  // namespace

DrawnAspect drawn_aspect(const Observer& camera, const Around& around, const World& world,
                         const RayScene& rays, const EyeCheck& check, const MoverPoses& poses,
                         std::uint64_t seed) {
    DrawnAspect drawn{placed_around(camera, around, world), ""};
    if (!around.draw_again) return drawn;
    const auto first = seen_from(drawn.observer, around, world, rays, check, poses);
    if (first && *first >= hidden_below) return drawn;
    RandomStream chance{hashed(seed) ^
                        name_hash(fmt::format("{} {} {} {}", camera.name, around.range,
                                              around.aspect_deg, around.elevation_deg))};
    double best = first.value_or(-1.0);
    Around taken = around;
    for (int i = 0; i < aspect_draws && best < seen_above; ++i) {
        Around other = around;
        other.aspect_deg = 360.0 * chance();
        const double rise = chance();
        if (i >= level_draws) {
            other.elevation_deg +=
                rise * std::max(0.0, highest_draw_deg - std::max(0.0, around.elevation_deg));
        }
        const Observer there = placed_around(camera, other, world);
        const auto seen = seen_from(there, around, world, rays, check, poses);
        if (!seen || *seen <= best) continue;
        best = *seen;
        drawn.observer = there;
        taken = other;
    }
    const std::string why =
        first ? fmt::format("{:.0f} % of \"{}\" visible", 100.0 * *first, around.object)
              : "the camera below the ground or inside an object";
    drawn.note = fmt::format(
        "observer {}: aspect {:g}, elevation {:g} degrees has {}; redrawn: aspect {:.1f}, "
        "elevation {:.1f} degrees, {:.0f} % of the surfaces that face the camera visible",
        camera.name, around.aspect_deg, around.elevation_deg, why, taken.aspect_deg,
        taken.elevation_deg, 100.0 * std::max(0.0, best));
    return drawn;
}

}  // namespace diurna
