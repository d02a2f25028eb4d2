#include "scenes/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/parallel.hpp"
#include "scenes/plan/instrument_cost.hpp"
#include "scenes/world/stepping.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/solve/point_facets.hpp"

namespace diurna {

namespace {

// What one core of the machine class that bench/results names takes, measured on the five sample
// scenes: seconds of the processor over the counts. For the estimate only.
constexpr double sky_per_facet = 14e-6;
constexpr double shadow_per_ground_facet = 0.25e-6;  // and sunlit step
constexpr double shadow_per_object_facet = 0.5e-6;   // more of them have edges to be found
constexpr double heat_per_facet_step = 0.55e-6;      // all passes and the exchange
constexpr double heat_per_lane = 0.7e-3;             // a wet day that repeats, eight side by side
constexpr double heat_per_freezing_lane = 8e-3;  // scenes/approach in January; even slopes 1.6 ms
constexpr double frost_air = 276.0;              // [K] under which open ground may freeze
constexpr double heat_per_point = 5e-3;          // a day (thermal/solve/point_facets.hpp)
constexpr double heat_per_target = 2e-3;         // a day of one (thermal/solve/network_facets)
constexpr double flux_passes = 1.3;              // of the heat balance, where it is taken down
constexpr double write_per_value = 0.08e-6;
constexpr double cast_per_ray = 0.3e-6;       // and what it meets by mirrors
constexpr double render_per_pixel = 0.75e-6;  // and band
constexpr double light_per_facet = 0.1e-6;    // and frame: its sun and temperature
constexpr double air_per_band = 0.09;         // and frame: tables of paths and backgrounds
constexpr double air_per_channel = 0.027;     // likewise of a cube
constexpr double render_per_channel = 0.12e-6;
constexpr double planes_of_picture = 14.0;   // of truth, beside those of its bands
constexpr double bytes_of_channel = 32.0;    // of a value of a cube: seen, put in two files
constexpr double bytes_of_value = 8.0;       // of a plane, and of the file that is made of it
constexpr double blur_per_sample = 0.7e-6;   // of an instrument's radiance and frame
constexpr double detect_per_pixel = 1.0e-6;  // and frame
constexpr double annotate_per_pixel = 0.25e-6;
constexpr double seen_through = 2.5;  // of casting and rendering, where rays pass smoke or nets

std::string wet_materials(const Scene& scene, const World& world, bool wet) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const MaterialId id : world.surfaces().material) used[index(id)] = true;
    std::vector<std::string> kinds;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const Material& material = scene.materials[MaterialId{static_cast<std::uint16_t>(i)}];
        if (!used[i] || (material.thermal.evaporation.wetness > 0.0) != wet) continue;
        if (std::find(kinds.begin(), kinds.end(), material.kind()) == kinds.end()) {
            kinds.push_back(material.kind());
        }
    }
    return kinds.empty() ? "none" : fmt::format("{}", fmt::join(kinds, ", "));
}

/// Processor time of facets that need more than their blocks give them, a day [s].
double point_seconds(const Scene& scene, const World& world, const Weather& weather) {
    const auto any = [&](auto has) {
        return std::any_of(weather.sample.begin(), weather.sample.end(), has);
    };
    const bool frost = any([](const Forcing& f) { return f.air.temperature < frost_air; });
    const bool rain = any([](const Forcing& f) { return f.rain_mm_h > 0.0; });
    std::vector<double> each;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const ThermalSurface& surface =
            scene.materials[MaterialId{static_cast<std::uint16_t>(i)}].thermal;
        const PointNeed need = point_need(surface);
        const bool freezing = need != PointNeed::never && frost && freezes(surface);
        const bool taken =
            need == PointNeed::always || (need == PointNeed::if_wet && rain) || freezing;
        const double in_lane = freezing ? heat_per_freezing_lane : heat_per_lane;
        each.push_back(!taken ? 0.0 : in_lanes(surface) ? in_lane : heat_per_point);
    }
    double sum = 0.0;
    for (const TargetFacets& target : world.targets) {
        for (const auto& [material, part] : target.part) each[index(material)] = heat_per_target;
    }
    for (const MaterialId id : world.facets.material) sum += each[index(id)];
    return sum;
}

/// How many instants, pixels and rays there are.
void count_work(const Scene& scene, const World& world, Plan& plan) {
    plan.facets = world.surfaces().size();
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
        plan.pictures += observer.frames.size();
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
        seconds += frames * (cost.seen_pixels * (through * render_per_pixel + blur_per_sample) +
                             double(observer.width) * observer.height * detect_per_pixel +
                             light_per_facet * double(plan.facets));
        plan.memory = std::max(plan.memory, cost.seen_pixels * 100.0);
        plan.decisions.push_back(
            {.what = "instrument " + cost.name,
             .computed = true,
             .why = cost.oversampling.why + fmt::format("; {} rays a sample", cost.samples),
             .error = 0.0,
             .error_unit = "W m-2 sr-1"});
        if (cost.left_out.empty()) continue;
        plan.decisions.push_back(
            {.what = "stages of instrument " + cost.name,
             .computed = false,
             .why = fmt::format("its settings have none: {}", fmt::join(cost.left_out, ", ")),
             .error = 0.0,
             .error_unit = "W m-2 sr-1"});
    }
    return seconds;
}

/// What each stage takes, and the memory of all.
void estimate(const Scene& scene, const World& world, const Weather& weather, Plan& plan) {
    const double facets = double(plan.facets);
    // That of details is by rays, as objects are.
    const double ground = double(world.ground_facets) -
                          double(std::count(world.on_detail.begin(), world.on_detail.end(), 1));
    const double threads = thread_count();
    const double steps = double(plan.steps.size()), sunlit = double(plan.sunlit_steps.size());
    const bool looks_through = !scene.plumes.empty();
    const double through = looks_through ? seen_through : 1.0;
    double band_pixels = 0.0, band_pictures = 0.0, largest_view = 0.0;
    double channel_pixels = 0.0, channel_pictures = 0.0;
    for (const ObserverInput& observer : scene.observers) {
        const double pixels = double(observer.width) * observer.height;
        const double pictures = double(observer.bands.size()) * double(observer.frames.size());
        band_pictures += pictures;
        band_pixels += pixels * pictures;
        double channels = 0.0;
        for (const std::string& cube : observer.cubes) channels += channels_of(scene, cube);
        const double planes =
            planes_of_picture + double(observer.bands.size()) * (observer.terms ? 8.0 : 2.0);
        channel_pictures += channels * double(observer.frames.size());
        channel_pixels += pixels * channels * double(observer.frames.size());
        largest_view = std::max(largest_view,
                                pixels * (160.0 + (looks_through ? 64.0 * observer.samples : 0.0) +
                                          bytes_of_value * planes + bytes_of_channel * channels));
    }
    const double points = point_seconds(scene, world, weather);
    const double instruments = instrument_seconds(scene, through, plan);
    // Fluxes: one more pass, eight values beside each temperature that is kept.
    const double kept = double(scene_span(scene).wanted.size());
    const double day_steps = 86400.0 / scene.time.step + 1.0;  // no more than a day is held
    const double passes = scene.output.fluxes ? flux_passes : 1.0;
    const double values = facets * kept * (scene.output.fluxes ? 9.0 : 1.0);
    plan.stages = {
        {"sky view", sky_per_facet * facets / threads},
        {"shadows",
         sunlit * (shadow_per_ground_facet * ground + shadow_per_object_facet * (facets - ground)) /
             threads},
        {"heat balance",
         passes * steps * (heat_per_facet_step * facets + points / 144.0) / threads},
        {"write temperatures", write_per_value * values},
        {"views", through * cast_per_ray * double(plan.view_rays) / threads},
        {"frames", (through * render_per_pixel * band_pixels + air_per_band * band_pictures +
                    render_per_channel * channel_pixels + air_per_channel * channel_pictures +
                    light_per_facet * facets * double(plan.pictures)) /
                       threads},
        {"report", annotate_per_pixel * double(plan.frame_pixels)},
    };
    if (!scene.instruments.empty()) {
        plan.stages.insert(plan.stages.end() - 1, {"instruments", instruments / threads});
    }
    plan.seconds = 0.0;
    for (const PlannedStage& stage : plan.stages) plan.seconds += stage.seconds;
    // Program and libraries; what a facet has once; six fields of a value for each step; views, of
    // one observer at a time.
    plan.memory += 110e6 + facets * (600.0 + 6.0 * 4.0 * std::min(steps, day_steps)) +
                   4.0 * values + largest_view;
}

std::vector<Decision> decisions_of(const Scene& scene, const World& world, const Plan& plan) {
    const std::size_t dark = plan.steps.size() - plan.sunlit_steps.size();
    const auto standing =
        std::size_t(std::count_if(scene.observers.begin(), scene.observers.end(),
                                  [](const ObserverInput& o) { return !o.goes(); }));
    const bool terms = std::any_of(scene.observers.begin(), scene.observers.end(),
                                   [](const ObserverInput& o) { return o.terms; });
    return {
        {.what = "shadows",
         .computed = true,
         .why =
             fmt::format("{} of {} steps have the sun up; {} at night cast no ray; an edge within "
                         "a step is found to 20 s, which is this much for some minutes",
                         plan.sunlit_steps.size(), plan.steps.size(), dark),
         .error = 0.4,
         .error_unit = "K"},
        {.what = "heat balance step by step",
         .computed = true,
         .why = "in modes of each material, rms over facets and instants (bench/results)",
         .error = 0.003,
         .error_unit = "K"},
        {.what = "evaporation",
         .computed = wet_materials(scene, world, true) != "none",
         .why = fmt::format("wet: {}; dry and left out: {}", wet_materials(scene, world, true),
                            wet_materials(scene, world, false)),
         .error = 0.0,
         .error_unit = "W m-2"},
        {.what = "exchange between facets",
         .computed = true,
         .why = "only where a facet's rays met another facet; open ground has no row",
         .error = 0.0,
         .error_unit = "W m-2"},
        {.what = "reflected sun at night",
         .computed = false,
         .why = "the sun is below the horizon",
         .error = 0.0,
         .error_unit = "W m-2 sr-1"},
        {.what = "radiance of unseen facets",
         .computed = false,
         .why = "no pixel holds them; their temperature still warms those that are seen",
         .error = 0.0,
         .error_unit = "W m-2 sr-1"},
        {.what = "rays per frame",
         .computed = false,
         .why = standing == scene.observers.size()
                    ? "nothing moves: each observer's view is cast once and kept for all frames"
                    : fmt::format("{} of {} observers stand: their views are cast once; those of "
                                  "the others for each frame",
                                  standing, scene.observers.size()),
         .error = 0.0,
         .error_unit = "W m-2 sr-1"},
        {.what = "terms of the radiance as planes",
         .computed = terms,
         .why = terms ? "observer.terms asks for them" : "no observer.terms asks for them",
         .error = 0.0,
         .error_unit = "W m-2 sr-1"},
    };
}

}  // namespace

Plan make_plan(const Scene& scene, const World& world, const Weather& weather) {
    Plan plan;
    count_work(scene, world, plan);
    estimate(scene, world, weather, plan);
    std::vector<Decision> decisions = decisions_of(scene, world, plan);
    decisions.insert(decisions.end(), plan.decisions.begin(), plan.decisions.end());
    plan.decisions = std::move(decisions);
    return plan;
}

std::string describe(const Plan& plan) {
    std::string text = fmt::format(
        "facets      {:>12}\n"
        "steps       {:>12}   {} with the sun up\n"
        "pictures    {:>12}   {:.4g} pixels, at {} instants\n"
        "rays        {:>12.4g}   sky {:.3g}, sun {:.3g}, views {:.3g}\n"
        "memory      {:>9.0f} MB  estimated\n"
        "time        {:>10.1f} s   estimated, {} threads\n",
        plan.facets, plan.steps.size() - 1, plan.sunlit_steps.size(), plan.pictures,
        double(plan.frame_pixels), plan.frames.size(),
        static_cast<double>(plan.sky_rays + plan.sun_rays + plan.view_rays),
        static_cast<double>(plan.sky_rays), static_cast<double>(plan.sun_rays),
        static_cast<double>(plan.view_rays), plan.memory / 1e6, plan.seconds, thread_count());
    for (const PlannedStage& stage : plan.stages) {
        text += fmt::format("  {:<18} {:>6.1f} s\n", stage.name, stage.seconds);
    }
    for (const Decision& decision : plan.decisions) {
        text += fmt::format("{:<9} {:<34} {} (error {:g} {})\n",
                            decision.computed ? "computed" : "skipped", decision.what, decision.why,
                            decision.error, decision.error_unit);
    }
    return text;
}

}  // namespace diurna
