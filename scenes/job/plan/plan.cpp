#include "scenes/job/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "materials/base/parallel.hpp"
#include "scenes/job/plan/network_facets.hpp"
#include "scenes/job/plan/plan_costs.hpp"
#include "scenes/job/plan/planned_memory.hpp"
#include "scenes/job/world/stepping.hpp"
#include "thermal/weather/sky_spread.hpp"

namespace diurna {

namespace {

/// How many instants, pixels and rays there are.
void count_work(const Scene& scene, const World& world, Plan& plan) {
    plan.facets = world.surfaces().size();
    plan.observers = scene.observers.size();
    plan.steps = scene_steps(scene);
    for (const Instant step : plan.steps) {
        if (sun_is_up(world.site, step)) plan.sunlit_steps.push_back(step);
    }
    plan.sun_rays = world.facets.size() * plan.sunlit_steps.size() *
                    static_cast<std::size_t>(scene.sun_samples);
    for (const ObserverInput& observer : scene.observers) {
        const std::size_t pixels = static_cast<std::size_t>(observer.width) * observer.height;
        plan.pixels += pixels;
        const std::size_t views = observer.goes() ? observer.frames.size() : 1;
        plan.view_rays += views * pixels * static_cast<std::size_t>(observer.samples);
        plan.views += observer.frames.size();
        plan.pictures += observer.frames.size() * observer.bands.size();
        plan.frame_pixels += pixels * observer.frames.size();
        plan.frames.insert(plan.frames.end(), observer.frames.begin(), observer.frames.end());
    }
    std::sort(plan.frames.begin(), plan.frames.end());
    plan.frames.erase(std::unique(plan.frames.begin(), plan.frames.end()), plan.frames.end());
}

/// What instruments add, in seconds of the processor; their rays are added to the plan's.
double instrument_seconds(const Scene& scene, Plan& plan) {
    double seconds = 0.0;
    for (const InstrumentInput& input : scene.instruments) {
        const ObserverInput& observer = observer_of(scene, input);
        const InstrumentCost cost = instrument_cost(scene, input);
        const double frames = double(observer.frames.size());
        const double views = observer.goes() ? frames : 1.0;
        const double rays = views * cost.seen_pixels * cost.samples;
        plan.view_rays += static_cast<std::size_t>(rays);
        seconds += frames *
                   (cost.seen_pixels * (plan_costs.render_per_pixel + plan_costs.blur_per_sample) +
                    double(observer.width) * observer.height * plan_costs.detect_per_pixel +
                    plan_costs.air_per_band + plan_costs.light_per_facet * double(plan.facets));
        plan.instruments.push_back(cost);
    }
    return seconds;
}

double onward_seconds(const FollowedLight& light) {
    return plan_costs.secondary_per_hit * light.secondary +
           plan_costs.lobes_per_root * light.lobes + plan_costs.smoke_pixel * light.smoke;
}

/// Heat once more for each uncertain value and for all together; views and pictures once more for
/// each.
void count_uncertain(std::size_t values, Plan& plan) {
    if (values == 0) return;
    const double solves = double(values) + (values > 1 ? 1.0 : 0.0);
    for (PlannedStage& stage : plan.stages) {
        if (stage.stage == StageId::heat_balance) stage.seconds *= 1.0 + solves;
        const bool again = stage.stage == StageId::views || stage.stage == StageId::frames;
        if (again || stage.stage == StageId::terrain) stage.seconds *= 1.0 + double(values);
    }
}

/// A round with edges divided by 2: four times as many facets, as many places to check.
double finer_round(const Plan& plan) {
    constexpr double more_facets = 4.0;
    double seconds = 0.0;
    for (const PlannedStage& stage : plan.stages) {
        if (stage.stage == StageId::surface_check) seconds += stage.seconds;
        if (stage.stage < StageId::surface_check) seconds += more_facets * stage.seconds;
    }
    return seconds;
}

/// What each stage takes, and the memory of all.
void estimate(const Scene& scene, const World& world, const Weather& weather, const RayScene* rays,
              std::span<const Sequence> sequences, std::span<const Plume> plumes, Plan& plan) {
    PlannedWork work{.sky = sky_work(scene, world),
                     .days = solved_days(scene, world.site, weather, plan.stages_of_motion > 1),
                     .pictures = picture_work(scene, world, weather, rays, sequences, plumes),
                     .facets = double(plan.facets),
                     .networks = double(network_facets(scene, world)),
                     .every = !plan.decisions.heat.every_facet.empty(),
                     .stages = double(plan.stages_of_motion)};
    work.solved = solved_facets(world, sequences, work.every, work.sky.close_ground);
    work.points = point_work(scene, world, weather, work.days);
    work.check = check_work(scene, plan.decisions.heat, work.stages, work.days);
    plan.sky_rays = static_cast<std::size_t>(
        work.stages * (work.sky.ground_rays + work.sky.wall_rays + work.sky.network_rays));
    const double facets = work.facets, networks = work.networks;
    // That of details is by rays, as objects are.
    const double ground = double(world.ground_facets) -
                          double(std::count(world.on_detail.begin(), world.on_detail.end(), 1));
    const double threads = thread_count();
    const double instruments = instrument_seconds(scene, plan);
    for (const InstrumentCost& cost : plan.instruments) {
        work.samples = std::max(work.samples, cost.seen_pixels);
    }
    // Fluxes: one more pass, eight values beside each temperature that is kept.
    const double kept = double(scene_span(scene).wanted.size());
    const double passes = scene.output.fluxes ? plan_costs.flux_passes : 1.0;
    work.values = facets * kept * (scene.output.fluxes ? 9.0 : 1.0);
    // Ground that lies finer than its tolerance asks for does so for objects, which it sees.
    const bool objects = !scene.terrain.objects.empty() || !scene.terrain.buildings.empty();
    const double columns = std::max(0.0, work.solved - networks);
    const double coupled = objects ? columns : 0.0;
    const double lit =
        weather.spreads ? double(std::min<std::size_t>(200, weather.spreads->instant.size())) : 0.0;
    const double sky = plan_costs.sky_per_facet * double(world.ground_facets) +
                       plan_costs.ground_ray * work.sky.ground_rays +
                       plan_costs.ground_hit * work.sky.ground_hits +
                       plan_costs.wall_ray * work.sky.wall_rays +
                       plan_costs.sky_per_ray * work.sky.network_rays;
    const std::string at_stages =
        work.stages > 1.0 ? fmt::format("at {:.0f} stages of moving objects", work.stages) : "";
    plan.stages = {
        {StageId::terrain,
         plan_costs.start + plan_costs.world_per_facet * facets + plan_costs.light_per_hour * lit},
        {StageId::sky_view, work.stages * sky / threads, at_stages},
        {StageId::shadows, work.solved / facets * work.days.sunlit *
                               (plan_costs.shadow_per_ground * ground +
                                plan_costs.shadow_per_object * (facets - ground)) /
                               threads},
        {StageId::heat_balance,
         passes *
             (work.days.steps * (plan_costs.heat_per_step * (columns - coupled) +
                                 plan_costs.heat_per_coupled_step * coupled) +
              work.days.days * plan_costs.heat_per_day * columns +
              (work.stages - 1.0) * plan_costs.heat_per_stage * facets +
              work.solved / facets * work.points.seconds +
              network_seconds(scene, networks, work.days)) /
             threads},
        {StageId::surface_check, work.check.seconds / threads,
         fmt::format("{:.0f} places{}", 0.5 * work.check.patches,
                     at_stages.empty() ? "" : " " + at_stages)},
        {StageId::write_temperatures, plan_costs.write_per_value * work.values},
        {StageId::views, (plan_costs.cast_per_ray * double(plan.view_rays) +
                          plan_costs.smoke_ray * work.pictures.smoke_rays +
                          plan_costs.textured_ray * work.pictures.textured_rays +
                          plan_costs.secondary_per_ray * work.pictures.followed_rays) /
                             threads},
        {StageId::frames,
         (plan_costs.render_per_pixel * work.pictures.pixels +
          plan_costs.render_per_surface * work.pictures.surface_pixels +
          plan_costs.air_per_band * work.pictures.pictures + onward_seconds(work.pictures.onward) +
          plan_costs.render_per_channel * work.pictures.channel_pixels +
          plan_costs.air_per_channel * work.pictures.channel_pictures +
          plan_costs.light_per_facet * facets * double(plan.views)) /
             threads},
        {StageId::report, plan_costs.annotate_per_pixel * double(plan.frame_pixels)},
    };
    if (!scene.instruments.empty()) {
        plan.stages.insert(
            plan.stages.end() - 1,
            {StageId::instruments,
             (instruments + onward_seconds(work.pictures.of_instruments)) / threads});
    }
    if (work.check.patches == 0.0) {
        std::erase_if(plan.stages,
                      [](const PlannedStage& one) { return one.stage == StageId::surface_check; });
    }
    count_uncertain(scene.uncertain.size(), plan);
    plan.seconds = 0.0;
    for (const PlannedStage& stage : plan.stages) plan.seconds += stage.seconds;
    plan.finer_seconds = finer_round(plan);
    plan.memory = planned_memory(scene, work);
}

}  // namespace

Plan make_plan(const Scene& scene, const World& world, const Weather& weather, const RayScene* rays,
               std::span<const Sequence> sequences, std::size_t stages_of_motion,
               std::span<const Plume> plumes) {
    Plan plan;
    plan.stages_of_motion = stages_of_motion;
    count_work(scene, world, plan);
    plan.decisions = decisions_of(scene, world, weather, sequences);
    estimate(scene, world, weather, rays, sequences, plumes, plan);
    return plan;
}

}  // namespace diurna
