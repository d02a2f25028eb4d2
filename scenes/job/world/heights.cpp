#include "scenes/job/world/heights.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/parallel.hpp"
#include "scenes/job/input/sea_height.hpp"
#include "scenes/job/world/ground_point.hpp"
#include "scenes/job/world/upper_air.hpp"

namespace diurna {

double height_above_sea(const World& world, const Eigen::Vector3d& place) {
    return world.sea_level_height + level_height(place);
}

double up_of(const World& world, const Eigen::Vector2d& place, const HeightInput& height) {
    const SceneFrame frame{world.site, world.sea_level_height};
    Eigen::Vector3d at(place.x(), place.y(), 0.0);
    const Geodetic below = to_geodetic(world.site, at);
    const double wanted =
        height.metres + (height.over == HeightOver::sea ? sea_at(frame, below) : 0.0);
    // Up leans away from the vertical with distance, and refraction bends it: three are to 1 µm.
    for (int pass = 0; pass < 3; ++pass) {
        at.z() += wanted - to_geodetic(world.site, at).height;
    }
    return at.z();
}

Eigen::Vector3d stand_point(const World& world, const Dem& dem, const Eigen::Vector2d& place,
                            const HeightInput& height, const std::string& where) {
    if (height.over != HeightOver::ground) {
        return {place.x(), place.y(), up_of(world, place, height)};
    }
    const auto ground = ground_point(dem, world.site, place, where,
                                     "there, set height_above_sea_m or height_above_ellipsoid_m");
    return ground + Eigen::Vector3d(0.0, 0.0, height.metres);
}

std::vector<float> facet_heights(const World& world) {
    const FacetSet& surfaces = world.surfaces();
    std::vector<float> height(surfaces.size());
    for_each_index(surfaces.size(), [&](std::size_t f) {
        height[f] = float(height_above_sea(world, surfaces.centroid[f].cast<double>()));
    });
    return height;
}

HeightSpan heights_of_surfaces(const World& world) {
    HeightSpan span{world.sea_level_height, world.sea_level_height};
    bool first = true;
    for (const Eigen::Vector3f& vertex : world.facets.vertex) {
        const double height = height_above_sea(world, vertex.cast<double>());
        span.low = first ? height : std::min(span.low, height);
        span.high = first ? height : std::max(span.high, height);
        first = false;
    }
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        const Eigen::AlignedBox3d box = world.copies.box(world.facets, c);
        span.low = std::min(span.low, height_above_sea(world, box.min()));
        span.high = std::max(span.high, height_above_sea(world, box.max()));
    }
    return span;
}

HeightSpan heights_of_ground(const World& world) {
    if (world.ground_facets == 0) return heights_of_surfaces(world);
    HeightSpan span{world.sea_level_height, world.sea_level_height};
    bool first = true;
    for (std::size_t f = 0; f < world.ground_facets; ++f) {
        for (const std::uint32_t v : world.facets.corner[f]) {
            const double height = height_above_sea(world, world.facets.vertex[v].cast<double>());
            span.low = first ? height : std::min(span.low, height);
            span.high = first ? height : std::max(span.high, height);
            first = false;
        }
    }
    return span;
}

AirByHeight air_by_height(const Scene& scene, const Weather& weather) {
    AirByHeight rule{.station = weather.height, .lapse = scene.weather.by_height.lapse};
    if (scene.weather.by_height.by_profile) rule.profile = upper_air(scene, weather);
    return rule;
}

std::string height_note(const Scene& scene, const World& world, const Weather& weather) {
    constexpr double level = 50.0, far_below = 100.0;  // [m]
    const HeightSpan span = heights_of_surfaces(world);
    const double up = span.high - weather.height, down = weather.height - span.low;
    if (up < level && down < level) return "";
    const AirByHeight rule = air_by_height(scene, weather);
    if (rule.same_everywhere()) {
        return fmt::format(
            "all ground from {:.0f} to {:.0f} m uses the air of the weather station at {:.0f} m: "
            "weather.lapse is 0",
            span.low, span.high, weather.height);
    }
    std::string note = fmt::format(
        "air temperature, sky and sun for ground from {:.0f} to {:.0f} m are adjusted from the "
        "weather station at {:.0f} m, by {}; the wind is unchanged",
        span.low, span.high, weather.height,
        rule.profile ? "the profile" : fmt::format("{:g} K/km", 1e3 * rule.lapse));
    if (down > far_below) {
        note += fmt::format(
            "; ground is up to {:.0f} m below the station: cold-air pools on clear, calm nights "
            "are not modelled",
            down);
    }
    return note;
}

}  // namespace diurna
