#include "scenes/run/series.hpp"

#include <algorithm>
#include <optional>

#include "materials/atmosphere/band_model.hpp"
#include "materials/matter/waves.hpp"
#include "render/light/radiance_input.hpp"
#include "render/picture/cube.hpp"
#include "render/rays/follow_rays.hpp"
#include "render/view/cast_view.hpp"
#include "scenes/run/appearances.hpp"
#include "scenes/run/behind_planes.hpp"

namespace diurna {

namespace {

/// The mean of all frames': for rays off water, of which a view has one set. What they meet near by
/// is weighed as in that wind; the sky between is that of each instant's.
double mean_wind(const Prepared& prepared, std::span<const Instant> frames) {
    double sum = 0.0;
    for (const Instant instant : frames) sum += wind_at(prepared, instant);
    return sum / std::max<double>(1.0, double(frames.size()));
}

}  // namespace

double wind_at(const Prepared& prepared, Instant instant) {
    return wind_over_water(prepared.weather.at(instant).wind_speed, prepared.weather.wind_height);
}

Series cast_series(const Prepared& prepared, const ObserverInput& input, const Observer& pose,
                   std::span<const Instant> frames, const FacetViews& views,
                   const TemperatureField& field, std::span<const std::uint8_t> asked) {
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
             .hops = {},
             .lit = {},
             .cubes = {},
             .behind = {}};
    for (const std::string& band : s.input.bands) {
        s.bands.push_back(named_band(scene.bands, band, bin_edges_um()));
    }
    std::vector<Appearance> looks;
    if (s.input.adaptive) looks = appearances(prepared, frames, views, field, s.bands);
    s.view = s.input.adaptive ? cast_adaptive_view(prepared.rays, surfaces, s.observer, looks,
                                                   *s.input.adaptive, s.sampling)
                              : cast_view(prepared.rays, surfaces, s.observer, s.sampling);
    s.behind =
        behind_planes(s.view, prepared.world, prepared.rays, scene.materials, s.observer, s.bands);
    const PlumeScene plumes(prepared.plumes);
    std::optional<HopSampling> by_need;
    if (s.input.adaptive) by_need = HopSampling{*s.input.adaptive, looks};
    s.hops = follow_rays(s.view,
                         {.rays = prepared.rays,
                          .facets = surfaces,
                          .materials = scene.materials,
                          .plumes = plumes,
                          .wind_speed = mean_wind(prepared, frames)},
                         s.observer, s.sampling, by_need ? &*by_need : nullptr);
    const RadianceInput still{.facets = surfaces,
                              .views = views,
                              .materials = scene.materials,
                              .atmosphere = Vacuum{},
                              .temperature = {},
                              .ground_height_km = prepared.world.sea_level_height / 1000.0};
    const std::vector<FacetId> seen = seen_facets(s.view.facet, s.hops);
    s.lit = lit_facets(still, seen, s.bands);
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
