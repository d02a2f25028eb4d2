#include "scenes/run/heat.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <span>
#include <vector>

#include "materials/matter/passed_light.hpp"
#include "scenes/world/measured_albedo.hpp"
#include "scenes/world/stepping.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/relief_visibility.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "thermal/solve/shadow_edges.hpp"

namespace diurna {

namespace {

ReliefVisibility light_of(const Prepared& prepared) {
    return {prepared.world.facets, prepared.rays, *prepared.world.relief,
            prepared.world.ground_facets};
}

}  // namespace

FacetViews scene_sky_view(const Prepared& prepared, bool sunlight) {
    const Scene& scene = prepared.scene;
    FacetViews view = light_of(prepared).facet_views({.rays = scene.sky_rays,
                                                      .first_object = prepared.world.ground_facets,
                                                      .object_rays = scene.object_sky_rays,
                                                      .seed = scene.seed,
                                                      .sunlight = sunlight});
    const std::vector<PassedLight> passed = passed_light(scene.materials);
    make_reciprocal(prepared.world.facets, view, {.passed = passed, .sunlight = sunlight});
    const TextureLevels& texture_levels = prepared.world.texture_levels;
    return texture_levels.empty() ? view : for_all_levels(texture_levels, view);
}

SunExposure scene_sun_exposure(const Prepared& prepared, const std::vector<Instant>& instants) {
    const Scene& scene = prepared.scene;
    const std::size_t facets = prepared.world.facets.size();
    const ReliefVisibility light = light_of(prepared);
    SunExposure exposure{.instant = instants, .fraction = {}};
    exposure.fraction.assign(exposure.instant.size() * facets, 0.0f);
    for (std::size_t i = 0; i < exposure.instant.size(); ++i) {
        const SunPosition sun = sun_position(prepared.world.site, exposure.instant[i]);
        light.sun_fraction(sun_direction(sun),
                           std::span(exposure.fraction).subspan(i * facets, facets),
                           {.samples = scene.sun_samples, .seed = scene.seed});
    }
    // When within a step the sun comes and goes: by rays, which answer for single facets.
    find_edges(exposure,
               [&](Instant when, std::span<const std::uint8_t> chosen, std::span<float> fraction) {
                   sun_fraction(prepared.world.facets, prepared.rays,
                                sun_direction(sun_position(prepared.world.site, when)), chosen,
                                fraction, {.samples = scene.sun_samples, .seed = scene.seed});
               },
               {.tolerance = 20.0});
    const TextureLevels& texture_levels = prepared.world.texture_levels;
    if (texture_levels.empty()) return exposure;
    exposure.fraction = for_all_levels(texture_levels, exposure.fraction);
    std::vector<ShadowEdge> edges;
    for (const ShadowEdge& edge : exposure.edge) {
        edges.push_back(edge);
        const TextureLevels::OfFacet& of_facet = texture_levels.of_facet[edge.facet];
        for (std::uint32_t copy = 0; copy + 1 < of_facet.levels; ++copy) {
            edges.push_back({edge.step, of_facet.first_copy + copy, edge.share});
        }
    }
    exposure.edge = std::move(edges);
    return exposure;
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
    const auto exposure = [&](const std::vector<Instant>& instants) {
        const auto begun = std::chrono::steady_clock::now();
        SunExposure sun = scene_sun_exposure(prepared, instants);
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
