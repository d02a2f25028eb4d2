#include "scenes/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "terrain/parallel.hpp"
#include "terrain/sun.hpp"

namespace diurna {

namespace {

// Rates of one core of the machine class the benches name (bench/results), for the estimate only.
constexpr double sky_rays_per_second = 5e6;
constexpr double sun_rays_per_second = 8e6;
constexpr double view_rays_per_second = 8e6;
constexpr double facet_steps_per_second = 4e6;
constexpr double passes = 4.0;
constexpr double frame_pixels_per_second = 3e6;

std::vector<Instant> instants(Instant start, double duration, double every) {
    std::vector<Instant> found;
    const int count = static_cast<int>(std::lround(duration / every));
    for (int i = 0; i <= count; ++i) found.push_back(later(start, i * every));
    return found;
}

std::string wet_materials(const Scene& scene, const World& world, bool wet) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const MaterialId id : world.surfaces().material) used[index(id)] = true;
    std::string names;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const Material& material = scene.materials[MaterialId{static_cast<std::uint16_t>(i)}];
        if (used[i] && (material.thermal.evaporation.wetness > 0.0) == wet) {
            names += (names.empty() ? "" : ", ") + material.name;
        }
    }
    return names.empty() ? "none" : names;
}

}  // namespace

Plan make_plan(const Scene& scene, const World& world) {
    Plan plan;
    plan.facets = world.surfaces().size();
    plan.steps = instants(scene.time.start, scene.time.duration, scene.time.step);
    plan.frames = instants(scene.time.start, scene.time.duration, scene.time.frame_every);
    plan.frames.pop_back();  // the end of a periodic day is its start
    for (const Instant step : plan.steps) {
        // The disc's upper edge and the refraction at the horizon: 0.27 and 0.57 degrees.
        if (sun_position(world.site, step).elevation_deg > -0.84) plan.sunlit_steps.push_back(step);
    }
    plan.sky_rays = world.ground_facets * static_cast<std::size_t>(scene.sky_rays) +
                    (world.facets.size() - world.ground_facets) *
                        static_cast<std::size_t>(scene.object_sky_rays);
    plan.sun_rays = world.facets.size() * plan.sunlit_steps.size() *
                    static_cast<std::size_t>(scene.sun_samples);
    std::size_t bands = 0;
    for (const ObserverInput& observer : scene.observers) {
        const std::size_t pixels = static_cast<std::size_t>(observer.width) * observer.height;
        plan.pixels += pixels;
        plan.view_rays += pixels * static_cast<std::size_t>(observer.samples);
        bands = std::max(bands, observer.bands.size());
    }

    const std::size_t kept = plan.frames.size() + 1;
    plan.memory =
        static_cast<double>(plan.facets) *
            (200.0 + 86.0 + 4.0 * static_cast<double>(plan.steps.size() + kept) + 8.0 * 40) +
        static_cast<double>(plan.pixels) * 60.0;
    const double threads = thread_count();
    plan.seconds =
        (plan.sky_rays / sky_rays_per_second + plan.sun_rays / sun_rays_per_second +
         plan.view_rays / view_rays_per_second +
         passes * static_cast<double>(plan.facets * plan.steps.size()) / facet_steps_per_second +
         static_cast<double>(plan.pixels * plan.frames.size() * bands) / frame_pixels_per_second) /
        threads;

    const std::size_t dark = plan.steps.size() - plan.sunlit_steps.size();
    plan.decisions = {
        {.what = "shadows",
         .computed = true,
         .why = fmt::format("{} of {} steps have the sun up; {} at night cast no ray",
                            plan.sunlit_steps.size(), plan.steps.size(), dark),
         .error = 0.0,
         .error_unit = "W m-2"},
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
         .why = "nothing moves: each observer's view is cast once and kept for all frames",
         .error = 0.0,
         .error_unit = "W m-2 sr-1"},
        {.what = "terms of the radiance as planes",
         .computed = std::any_of(scene.observers.begin(), scene.observers.end(),
                                 [](const ObserverInput& o) { return o.terms; }),
         .why = "observer.terms asks for them",
         .error = 0.0,
         .error_unit = "W m-2 sr-1"},
    };
    return plan;
}

std::string describe(const Plan& plan) {
    std::string text = fmt::format(
        "facets      {:>12}\n"
        "steps       {:>12}   {} with the sun up\n"
        "frames      {:>12}   {} pixels each\n"
        "rays        {:>12.4g}   sky {:.3g}, sun {:.3g}, views {:.3g}\n"
        "memory      {:>9.0f} MB\n"
        "time        {:>10.0f} s   estimated, {} threads\n",
        plan.facets, plan.steps.size() - 1, plan.sunlit_steps.size(), plan.frames.size(),
        plan.pixels, static_cast<double>(plan.sky_rays + plan.sun_rays + plan.view_rays),
        static_cast<double>(plan.sky_rays), static_cast<double>(plan.sun_rays),
        static_cast<double>(plan.view_rays), plan.memory / 1e6, std::max(1.0, plan.seconds),
        thread_count());
    for (const Decision& decision : plan.decisions) {
        text += fmt::format("{:<9} {:<34} {} (error {:g} {})\n",
                            decision.computed ? "computed" : "skipped", decision.what, decision.why,
                            decision.error, decision.error_unit);
    }
    return text;
}

}  // namespace diurna
