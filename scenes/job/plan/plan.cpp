#include "scenes/job/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "materials/base/number_of.hpp"
#include "materials/base/parallel.hpp"
#include "render/rays/lobe.hpp"
#include "scenes/job/plan/dew_expected.hpp"
#include "scenes/job/plan/plan_costs.hpp"
#include "scenes/job/plan/seen_pixels.hpp"
#include "scenes/job/world/stepping.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/solve/point_facets.hpp"
#include "thermal/weather/sky_spread.hpp"

namespace diurna {

namespace {

constexpr const PlanCosts& costs = plan_costs;
constexpr double frost_air = 276.0;  // [K] under which open ground may freeze
constexpr double one_day = 86400.0;
constexpr double network_longest = 300.0;   // [s] steps of bodies of heat (network_facets.hpp)
constexpr double planes_of_picture = 14.0;  // of truth, beside those of its bands
constexpr std::size_t most_poses = 12;      // of a way, at which what is seen is counted

/// Facets that need more than their blocks give them.
struct PointWork {
    double seconds = 0.0;   // of the processor
    double freezing = 0.0;  // facets whose water freezes
};

/// Most of their time is where
/// dew, rain and frost come and go, however long the steps are; the first day repeats.
PointWork point_work(const Scene& scene, const World& world, const Weather& weather) {
    // Of the span, and of the days before it that its start may take.
    const Instant from = later(scene.time.start, -one_day * scene.time.days_before);
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
    const bool dew = dew_expected(weather, world.site, scene.time.start, scene.time.end());
    std::vector<double> each, cold;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const ThermalSurface& surface =
            scene.materials[MaterialId{static_cast<std::uint16_t>(i)}].thermal;
        const PointNeed need = point_need(surface);
        const bool freezing = need != PointNeed::never && frost && freezes(surface);
        const bool taken =
            need == PointNeed::always || freezing ||
            (need == PointNeed::if_wet && (rain || (dew && !(surface.evaporation.wetness > 0.0))));
        const double in_lane = freezing ? costs.freezing_lane : costs.lane;
        cold.push_back(freezing && in_lanes(surface) ? 1.0 : 0.0);
        each.push_back(!taken ? 0.0 : in_lanes(surface) ? in_lane : costs.point);
    }
    for (const TargetFacets& target : world.targets) {
        for (const auto& [material, part] : target.part)
            each[index(material)] = cold[index(material)] = 0.0;
    }
    PointWork work;
    for (const MaterialId id : world.facets.material) {
        work.seconds += each[index(id)];
        work.freezing += cold[index(id)];
    }
    const double steps = one_day / scene.time.step;
    const double more = std::max(0.0, scene.time.duration / one_day - 1.0);
    work.seconds *= (1.0 + costs.lane_by_steps * steps) * (1.0 + costs.lane_day_more * more);
    return work;
}

/// (material) whether its facets are of a body of heat.
std::vector<bool> of_networks(const Scene& scene, const World& world) {
    std::vector<bool> of(scene.materials.size(), false);
    for (const TargetFacets& target : world.targets) {
        for (const auto& [material, part] : target.part) of[index(material)] = true;
    }
    return of;
}

std::size_t network_facets(const Scene& scene, const World& world) {
    const std::vector<bool> of = of_networks(scene, world);
    return static_cast<std::size_t>(std::count_if(world.facets.material.begin(),
                                                  world.facets.material.end(),
                                                  [&](MaterialId id) { return of[index(id)]; }));
}

/// Processor time of bodies of heat [s]: their first day repeats, those after it are gone through.
double network_seconds(const Scene& scene, std::size_t facets) {
    const double steps = one_day / std::min(scene.time.step, network_longest);
    const double more = std::max(0.0, scene.time.duration / one_day - 1.0);
    return double(facets) * (costs.network_day + costs.network_step * steps) *
           (1.0 + costs.network_day_more * more);
}

/// Pixels of a picture that send rays on, mean over an observer's views.
struct Onward {
    double followed = 0.0;  // one by one: off water and smooth mirrors, through panes and nets
    double all = 0.0;       // these, and paints whose gloss is summed over a lobe
};

bool follows_rays(const Material& material) {
    const auto* const gloss = std::get_if<Glossy>(&material.finish);
    return material.see_through ||
           (gloss != nullptr && (gloss->waves || gloss->roughness < least_lobe));
}

Onward onward_pixels(const Scene& scene, const World& world, const Sequence& sequence) {
    if (sequence.pose.empty()) return {};
    const auto with = [&](const auto& has) {
        std::vector<bool> of(scene.materials.size());
        for (std::size_t i = 0; i < of.size(); ++i) {
            of[i] = has(scene.materials[MaterialId{static_cast<std::uint16_t>(i)}]);
        }
        return of;
    };
    const std::vector<bool> followed = with(follows_rays),
                            all = with([](const Material&m) { return m.needs_rays(); });
    const std::size_t count = std::min(most_poses, sequence.pose.size());
    Onward mean;
    for (std::size_t k = 0; k < count; ++k) {
        const Observer& pose = sequence.pose[k * sequence.pose.size() / count];
        const auto pixels = [&](const std::vector<bool>& of) {
            return seen_pixels(pose, world.facets, [&](MaterialId id) { return of[index(id)]; }) /
                   double(count);
        };
        mean.followed += pixels(followed);
        mean.all += pixels(all);
    }
    return mean;
}

/// How many instants, pixels and rays there are.
void count_work(const Scene& scene, const World& world, Plan& plan) {
    plan.facets = world.surfaces().size();
    plan.observers = scene.observers.size();
    plan.steps = scene_steps(scene);
    for (const Instant step : plan.steps) {
        // The disc's upper edge and the refraction at the horizon: 0.27 and 0.57 degrees.
        if (sun_position(world.site, step).elevation_deg > -0.84) plan.sunlit_steps.push_back(step);
    }
    plan.sky_rays = world.ground_facets * static_cast<std::size_t>(scene.sky_rays) +
                    (world.facets.size() - world.ground_facets) *
                        static_cast<std::size_t>(scene.object_sky_rays);
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

double channels_of(const Scene& scene, const std::string& cube) {
    const auto at = std::find_if(scene.cubes.begin(), scene.cubes.end(),
                                 [&](const CubeInput& one) { return one.name == cube; });
    return at == scene.cubes.end() ? 0.0 : double(at->channels);
}

/// What instruments add, in seconds of the processor; their rays are added to the plan's.
double instrument_seconds(const Scene& scene, double through, Plan& plan) {
    double seconds = 0.0;
    for (const InstrumentInput& input : scene.instruments) {
        const ObserverInput& observer = observer_of(scene, input);
        const InstrumentCost cost = instrument_cost(scene, input);
        const double frames = double(observer.frames.size());
        const double views = observer.goes() ? frames : 1.0;
        const double rays = views * cost.seen_pixels * cost.samples;
        plan.view_rays += static_cast<std::size_t>(rays);
        seconds += frames *
                   (cost.seen_pixels * (through * costs.render_per_pixel + costs.blur_per_sample) +
                    double(observer.width) * observer.height * costs.detect_per_pixel +
                    costs.light_per_facet * double(plan.facets));
        plan.memory = std::max(plan.memory, cost.seen_pixels * 100.0);
        plan.instruments.push_back(cost);
    }
    return seconds;
}

/// What pictures of observers take.
struct PictureWork {
    double pictures = 0.0, pixels = 0.0;                  // of bands
    double channel_pictures = 0.0, channel_pixels = 0.0;  // of cubes
    double followed_rays = 0.0;                           // that go on, one by one
    double onward = 0.0;        // of bands: roots of the pixels that send rays on
    double largest_view = 0.0;  // [bytes]
};

PictureWork picture_work(const Scene& scene, const World& world,
                         std::span<const Sequence> sequences) {
    PictureWork work;
    for (std::size_t o = 0; o < scene.observers.size(); ++o) {
        const ObserverInput& observer = scene.observers[o];
        const double pixels = double(observer.width) * observer.height;
        const double bands = double(observer.bands.size());
        const double frames = double(observer.frames.size());
        double channels = 0.0;
        for (const std::string& cube : observer.cubes) channels += channels_of(scene, cube);
        work.pictures += bands * frames;
        work.pixels += pixels * bands * frames;
        work.channel_pictures += channels * frames;
        work.channel_pixels += pixels * channels * frames;
        const double planes = planes_of_picture + bands * (observer.terms ? 8.0 : 2.0);
        const double behind = scene.plumes.empty() ? 0.0 : 64.0 * observer.samples;
        work.largest_view = std::max(
            work.largest_view, pixels * (costs.view_pixel + behind + costs.plane_value * planes +
                                         costs.channel_value * channels));
        if (o >= sequences.size()) continue;
        const Onward onward = onward_pixels(scene, world, sequences[o]);
        const bool by_need = observer.adaptive || (observer.samples >= 4 && observer.surfaces == 0);
        work.followed_rays += onward.followed * double(sequences[o].pose.size()) *
                              observer.samples * (by_need ? costs.samples_by_need : 1.0);
        work.onward += std::sqrt(onward.all) * frames * bands;
    }
    return work;
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

/// Facets that are solved, as far as is known before views are cast.
double solved_facets(const Scene& scene, const Plan& plan, double networks) {
    const double all = double(plan.facets);
    if (!plan.decisions.heat.every_facet.empty()) return all;
    double pixels = 0.0;  // of which none shows what another does
    for (const ObserverInput& observer : scene.observers) {
        const double views = observer.goes() ? double(observer.frames.size()) : 1.0;
        pixels += views * double(observer.width) * double(observer.height);
    }
    return std::min(all, networks + costs.solved_per_pixel * pixels);
}

/// What each stage takes, and the memory of all.
void estimate(const Scene& scene, const World& world, const Weather& weather,
              std::span<const Sequence> sequences, Plan& plan) {
    const double facets = double(plan.facets);
    const double networks = double(network_facets(scene, world));
    // That of details is by rays, as objects are.
    const double ground = double(world.ground_facets) -
                          double(std::count(world.on_detail.begin(), world.on_detail.end(), 1));
    const double threads = thread_count();
    const double steps = double(plan.steps.size()), sunlit = double(plan.sunlit_steps.size());
    const double through = scene.plumes.empty() ? 1.0 : costs.seen_through;
    const PictureWork work = picture_work(scene, world, sequences);
    const PointWork points = point_work(scene, world, weather);
    const double instruments = instrument_seconds(scene, through, plan);
    // Fluxes: one more pass, eight values beside each temperature that is kept.
    const double kept = double(scene_span(scene).wanted.size());
    const double day_steps = one_day / scene.time.step + 1.0;  // no more than a day is held
    const double passes = scene.output.fluxes ? costs.flux_passes : 1.0;
    const double values = facets * kept * (scene.output.fluxes ? 9.0 : 1.0);
    // Ground that lies finer than its tolerance asks for does so for objects, which it sees.
    const bool objects = !scene.terrain.objects.empty() || !scene.terrain.buildings.empty();
    const double coupled = objects ? facets - networks : 0.0;
    const double lit =
        weather.spreads ? double(std::min<std::size_t>(200, weather.spreads->instant.size())) : 0.0;
    plan.stages = {
        {StageId::terrain,
         costs.start + costs.world_per_facet * facets + costs.light_per_hour * lit},
        {StageId::sky_view, (costs.sky_per_facet * (facets - networks) +
                             costs.sky_per_ray * networks * scene.object_sky_rays) /
                                threads},
        {StageId::shadows,
         sunlit * (costs.shadow_per_ground * ground + costs.shadow_per_object * (facets - ground)) /
             threads},
        {StageId::heat_balance,
         passes *
             (steps * (costs.heat_per_step * (facets - networks - coupled) +
                       costs.heat_per_coupled_step * coupled) +
              points.seconds + network_seconds(scene, static_cast<std::size_t>(networks))) /
             threads},
        {StageId::write_temperatures, costs.write_per_value * values},
        {StageId::views, (through * costs.cast_per_ray * double(plan.view_rays) +
                          costs.secondary_per_ray * work.followed_rays) /
                             threads},
        {StageId::frames,
         (through * costs.render_per_pixel * work.pixels + costs.air_per_band * work.pictures +
          costs.secondary_per_root * work.onward + costs.render_per_channel * work.channel_pixels +
          costs.air_per_channel * work.channel_pictures +
          costs.light_per_facet * facets * double(plan.views)) /
             threads},
        {StageId::report, costs.annotate_per_pixel * double(plan.frame_pixels)},
    };
    if (!scene.instruments.empty()) {
        plan.stages.insert(plan.stages.end() - 1, {StageId::instruments, instruments / threads});
    }
    count_uncertain(scene.uncertain.size(), plan);
    plan.seconds = 0.0;
    for (const PlannedStage& stage : plan.stages) plan.seconds += stage.seconds;
    // Program and libraries, and what a facet has once; then the heat balance, or temperatures and
    // views, of one observer at a time.
    const double others = double(scene.uncertain.size());  // scenes with a value changed
    const double object_facets =
        std::min(facets - double(world.ground_facets), solved_facets(scene, plan, networks));
    const double of_day = std::min(1.0, day_steps / std::max(1.0, steps));
    const double heat =
        solved_facets(scene, plan, networks) *
            (costs.solved_facet +
             of_day * (costs.solved_step * steps + costs.sunlit_step * sunlit)) +
        networks * (costs.network_facet + costs.network_facet_step * of_day * steps) +
        costs.object_ray * object_facets * std::max(0, scene.object_sky_rays - 32) +
        costs.freezing_facet * points.freezing;
    const double pictures = plan.memory + work.largest_view * (1.0 + others) +
                            4.0 * values * (1.0 + others) +
                            (scene.observers.empty() ? 0.0 : costs.pictured_facet * facets);
    plan.memory = costs.program + costs.facet * facets +
                  others * (costs.other_scene + costs.other_facet * facets) +
                  std::max(heat, pictures);
}

}  // namespace

Plan make_plan(const Scene& scene, const World& world, const Weather& weather,
               std::span<const Sequence> sequences) {
    Plan plan;
    count_work(scene, world, plan);
    plan.decisions = decisions_of(scene, world, weather, sequences);
    estimate(scene, world, weather, sequences, plan);
    return plan;
}

}  // namespace diurna
