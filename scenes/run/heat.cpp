#include "scenes/run/heat.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <span>
#include <vector>

#include "materials/matter/passed_light.hpp"
#include "scenes/run/sun_exposure.hpp"
#include "scenes/world/measured_albedo.hpp"
#include "scenes/world/stepping.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/relief_visibility.hpp"

namespace diurna {

FacetViews scene_sky_view(const Prepared& prepared, bool sunlight) {
    const Scene& scene = prepared.scene;
    const ReliefVisibility light(prepared.world.facets, prepared.rays, *prepared.world.relief,
                                 prepared.world.ground_facets);
    FacetViews view = light.facet_views({.rays = scene.sky_rays,
                                         .first_object = prepared.world.ground_facets,
                                         .object_rays = scene.object_sky_rays,
                                         .seed = scene.seed,
                                         .sunlight = sunlight});
    const std::vector<PassedLight> passed = passed_light(scene.materials);
    make_reciprocal(prepared.world.facets, view, {.passed = passed, .sunlight = sunlight});
    const TextureLevels& texture_levels = prepared.world.texture_levels;
    return texture_levels.empty() ? view : for_all_levels(texture_levels, view);
}

std::string not_converged(const SolveReport& report) {
    if (report.converged) return "";
    return fmt::format(
        "the heat balance has not converged in {} passes: periodic to {:.1e} K (tolerance {:.0e} "
        "K), estimated error {:.1e} K",
        report.passes, report.periodic_residual, SolveOptions{}.tolerance, report.estimated_error);
}

SpanResult solve_scene(const Prepared& prepared, const FacetViews& views, Progress& progress) {
    progress.stage("heat balance");
    double shadows = 0.0;
    SpanOptions span = scene_span(prepared.scene);
    span.day.progress = [&](double share) { progress.done(share); };
    std::optional<FacetViews> sunlight_views;
    if (passes_by_spectrum(passed_light(prepared.scene.materials))) {
        sunlight_views = scene_sky_view(prepared, true);
    }
    const SunExposure none;
    DailySunExposure daily(prepared, span.end);
    const auto exposure = [&](const std::vector<Instant>& instants) {
        const auto begun = std::chrono::steady_clock::now();
        SunExposure sun = daily.of(instants);
        shadows += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        return sun;
    };
    const MeasuredAlbedo albedo = measured_albedo(prepared.scene, prepared.world, prepared.weather);
    SpanResult result = solve_span({.facets = prepared.world.surfaces(),
                                    .views = views,
                                    .sun = none,
                                    .materials = prepared.scene.materials,
                                    .weather = prepared.weather,
                                    .site = prepared.world.site,
                                    .elevation = prepared.world.sea_level_height,
                                    .clear_sky = prepared.scene.sky,
                                    .measured_share = albedo.share,
                                    .sunlight_views = sunlight_views ? &*sunlight_views : nullptr},
                                   exposure, span);
    progress.set_apart("shadows", shadows);
    return result;
}

}  // namespace diurna
