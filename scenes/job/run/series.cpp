#include "scenes/job/run/series.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "materials/atmosphere/band_model.hpp"
#include "materials/matter/waves.hpp"
#include "render/light/radiance_input.hpp"
#include "render/picture/cube.hpp"
#include "render/rays/follow_rays.hpp"
#include "render/view/cast_view.hpp"
#include "render/view/linear_facets.hpp"
#include "scenes/job/plan/picture_samples.hpp"
#include "scenes/job/run/appearances.hpp"
#include "scenes/job/run/behind_planes.hpp"
#include "scenes/job/run/light_heights.hpp"

namespace diurna {

namespace {

/// The mean of all frames': for rays off water, of which a view has one set. What they meet near by
/// is weighed as in that wind; the sky between is that of each instant's.
double mean_wind(const Prepared& prepared, std::span<const Instant> frames) {
    double sum = 0.0;
    for (const Instant instant : frames) sum += wind_at(prepared, instant);
    return sum / std::max<double>(1.0, double(frames.size()));
}

/// Of some surfaces those on facets that share a corner with a visible one.
std::vector<SurfaceId> beside(const World& world, std::span<const SurfaceId> seen,
                              std::span<const SurfaceId> some) {
    const auto corners = [&](SurfaceId surface) {
        return world.facets.corner[index(world.texture_levels.facet_of(surface))];
    };
    std::vector<std::uint8_t> touched(world.facets.vertex.size(), 0);
    for (const SurfaceId surface : seen) {
        for (const std::uint32_t v : corners(surface)) touched[v] = 1;
    }
    std::vector<SurfaceId> found;
    for (const SurfaceId surface : some) {
        const auto [a, b, c] = corners(surface);
        if (touched[a] || touched[b] || touched[c]) found.push_back(surface);
    }
    return found;
}

}  // namespace

double wind_at(const Prepared& prepared, Instant instant) {
    return wind_over_water(prepared.weather.at(instant).wind_speed, prepared.weather.wind_height);
}

Series cast_series(const Prepared& prepared, const ObserverInput& input, const Observer& pose,
                   std::span<const Instant> frames, const FacetViews& views,
                   const TemperatureField& field, std::span<const std::uint8_t> asked,
                   std::optional<View> known) {
    const Scene& scene = prepared.scene;
    const FacetSet& surfaces = prepared.world.surfaces();
    Series s{.input = input,
             .observer = pose,
             .bands = {},
             .sampling = {.samples = input.samples,
                          .seed = scene.seed,
                          .texture_levels = &prepared.world.texture_levels,
                          .asked = asked},
             .view = {},
             .secondary_rays = {},
             .lit = {},
             .fits = {},
             .cubes = {},
             .behind = {}};
    for (const std::string& band : s.input.bands) {
        s.bands.push_back(named_band(scene.bands, band, bin_edges_um()));
    }
    const std::optional<AdaptiveOptions> adaptive =
        s.input.adaptive || asked.empty() ? adaptive_samples(s.input) : std::nullopt;
    std::vector<Band> looked_at = s.bands;
    if (!s.input.adaptive) looked_at = {named_band(scene.bands, "8-12", bin_edges_um())};
    const bool estimated = !adaptive && asked.empty() && s.input.samples >= 2;
    std::vector<Appearance> looks;
    if (adaptive) looks = appearances(prepared, frames, views, field, looked_at);
    if (!s.input.adaptive) {
        for (Appearance& look : looks) without_textures(prepared.world.texture_levels, look);
    }
    const bool all_with_samples = asked.empty() && (!adaptive || adaptive->from == s.input.samples);
    if (!all_with_samples) known.reset();
    s.view = adaptive ? cast_adaptive_view(prepared.rays, surfaces, s.observer, looks, *adaptive,
                                           s.sampling, std::move(known))
             : known  ? std::move(*known)
                      : cast_view(prepared.rays, surfaces, s.observer, s.sampling);
    if (estimated) s.view.samples.assign(s.view.pixels(), float(s.input.samples));
    s.behind =
        behind_planes(s.view, prepared.world, prepared.rays, scene.materials, s.observer, s.bands);
    const PlumeScene plumes(prepared.plumes);
    std::optional<SecondarySampling> by_need;
    if (const auto options = adaptive_secondary(scene, s.input); adaptive && options) {
        by_need = SecondarySampling{*options, looks};
    }
    s.secondary_rays = follow_rays(s.view,
                                   {.rays = prepared.rays,
                                    .facets = surfaces,
                                    .materials = scene.materials,
                                    .plumes = plumes,
                                    .wind_speed = mean_wind(prepared, frames)},
                                   s.observer, s.sampling, by_need ? &*by_need : nullptr);
    RadianceInput still{.facets = surfaces,
                        .views = views,
                        .materials = scene.materials,
                        .atmosphere = Vacuum{},
                        .temperature = {},
                        .ground_height_km = prepared.world.sea_level_height / 1000.0};
    set_light_heights(prepared, still);
    const std::vector<SurfaceId> seen = seen_surfaces(s.view.surface, s.secondary_rays);
    s.lit = lit_facets(still, seen, s.bands);
    s.fits = CornerFits(surfaces, facets_with_slopes(s.view));
    s.beside_seen = beside(prepared.world, s.view.surface, s.lit.facet);
    for (const std::string& name : s.input.cubes) {
        const auto cube = std::find_if(scene.cubes.begin(), scene.cubes.end(),
                                       [&](const CubeInput& c) { return c.name == name; });
        CubeSeries& series = s.cubes.emplace_back(CubeSeries{
            name, channel_bands(cube->from_um, cube->to_um, cube->channels, bin_edges_um()), {}});
        series.lit = lit_facets(still, seen, series.channels);
    }
    return s;
}

}  // namespace diurna
