#include "scenes/job/plan/heat_work.hpp"

#include <algorithm>
#include <vector>

#include "scenes/job/plan/dew_expected.hpp"
#include "scenes/job/plan/network_facets.hpp"
#include "scenes/job/plan/plan_costs.hpp"
#include "scenes/job/plan/seen_pixels.hpp"
#include "thermal/solve/point_facets.hpp"
#include "thermal/weather/repeated_day.hpp"

namespace diurna {

namespace {

constexpr double frost_air = 276.0;        // [K] under which open ground may freeze
constexpr double network_longest = 300.0;  // [s] steps of targets (thermal/solve/network_facets)

}  // namespace

PointWork point_work(const Scene& scene, const World& world, const Weather& weather,
                     const SolvedDays& days) {
    // Of the span, and of the days before it that its start may take.
    const Instant from = later(scene.time.start, -seconds_of_day * scene.time.days_before);
    const auto any = [&](auto has) {
        for (std::size_t i = 0; i < weather.instant.size(); ++i) {
            const bool counts =
                weather.instant[i] >= from && weather.instant[i] <= scene.time.end();
            if (counts && has(weather.sample[i])) return true;
        }
        return false;
    };
    const bool frost = any([](const Forcing& f) { return f.air.temperature < frost_air; });
    const bool rain = any([](const Forcing& f) { return f.rain_mm_h > 0.0; });
    std::vector<double> each, cold, wet;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const ThermalSurface& surface =
            scene.materials[MaterialId{static_cast<std::uint16_t>(i)}].thermal;
        const PointNeed need = point_need(surface);
        const bool dew =
            need == PointNeed::if_wet && !(surface.evaporation.wetness > 0.0) &&
            dew_expected(surface, weather, world.site, scene.time.start, scene.time.end());
        const bool freezing = need != PointNeed::never && frost && freezes(surface);
        const bool taken =
            need == PointNeed::always || freezing || dew || (need == PointNeed::if_wet && rain);
        const bool snow = taken && frost && (rain || surface.snow_albedo);
        const double in_lane = freezing || snow ? plan_costs.freezing_lane : plan_costs.lane;
        cold.push_back(freezing && in_lanes(surface) ? 1.0 : 0.0);
        wet.push_back(taken ? 1.0 : 0.0);
        each.push_back(!taken ? 0.0 : in_lanes(surface) ? in_lane : plan_costs.point);
    }
    const std::vector<bool> networks = of_networks(scene, world);
    for (std::size_t i = 0; i < networks.size(); ++i) {
        if (networks[i]) each[i] = cold[i] = wet[i] = 0.0;
    }
    PointWork work;
    for (const MaterialId id : world.surfaces().material) {
        work.seconds += each[index(id)];
        work.wet += wet[index(id)];
        work.freezing += cold[index(id)];
    }
    const double steps = seconds_of_day / scene.time.step;
    work.seconds *= (1.0 + plan_costs.lane_by_steps * steps) *
                    (days.repeated + plan_costs.lane_day_more * days.more);
    return work;
}

double solved_facets(const World& world, std::span<const Sequence> sequences, bool every,
                     double close_ground) {
    const FacetSet& surfaces = world.surfaces();
    const double all = double(surfaces.size());
    if (every) return all;
    std::vector<Observer> poses;
    for (const Sequence& sequence : sequences) {
        const std::size_t count = std::min(most_poses, sequence.pose.size());
        for (std::size_t k = 0; k < count; ++k)
            poses.push_back(sequence.pose[k * sequence.pose.size() / count]);
    }
    const double objects = double(world.facets.size() - world.ground_facets);
    return std::min(all, objects + plan_costs.solved_per_close * close_ground +
                             plan_costs.solved_per_seen * seen_facets(poses, surfaces));
}

double network_seconds(const Scene& scene, double facets, const SolvedDays& days) {
    const double steps = seconds_of_day / std::min(scene.time.step, network_longest);
    // Of a day before the span only the end is needed.
    const double first = days.leads_in ? plan_costs.network_lead_in : days.repeated;
    return facets * (plan_costs.network_day + plan_costs.network_step * steps) *
           (first + plan_costs.network_day_more * days.more);
}

}  // namespace diurna
