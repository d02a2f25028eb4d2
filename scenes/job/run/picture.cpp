#include "scenes/job/run/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "render/picture/cube.hpp"
#include "render/tracer.hpp"
#include "render/view/linear_facets.hpp"
#include "render/view/pixel_heat.hpp"
#include "render/view/pixel_sun.hpp"
#include "scenes/job/run/covered_surfaces.hpp"
#include "scenes/job/run/ground_to_horizon.hpp"
#include "scenes/job/run/light_heights.hpp"
#include "scenes/job/run/measured_materials.hpp"
#include "scenes/job/run/remembered_sun.hpp"
#include "scenes/job/run/sample_error.hpp"
#include "scenes/job/run/sun_on_surfaces.hpp"
#include "scenes/job/world/light_source.hpp"
#include "terrain/place/local_time.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

/// A picture with a radiance that is no number is our mistake, and not to be written.
void check_finite(const Frame& frame, const std::vector<std::string>& bands) {
    for (const std::string& band : bands) {
        const std::vector<float>& radiance = frame["radiance." + band].pixel;
        const auto bad = std::find_if_not(radiance.begin(), radiance.end(),
                                          [](float value) { return std::isfinite(value); });
        if (bad == radiance.end()) continue;
        const auto pixel = bad - radiance.begin();
        throw std::runtime_error(fmt::format("{}: radiance.{} is not finite at column {}, row {}",
                                             frame_name(frame, band), band, pixel % frame.width,
                                             pixel / frame.width));
    }
}

/// All that a frame of an observer shows.
std::vector<Band> lit_bands(const Series& s) {
    std::vector<Band> all = s.bands;
    for (const CubeSeries& cube : s.cubes) {
        all.insert(all.end(), cube.channels.begin(), cube.channels.end());
    }
    return all;
}

std::string moon_note(const LightSource& light) {
    return fmt::format(
        "replaces the sun below {:g} um: azimuth {:.2f} deg, elevation {:.2f} deg, phase {:.1f} "
        "deg, {:.0f} % illuminated; {:.2e} of the sun's irradiance at 0.55 um",
        moonlight_ends_um, light.place.azimuth_deg, light.place.elevation_deg,
        light.moon->phase_deg, 100.0 * lit_share(*light.moon), moon_over_sun(0.55, *light.moon));
}

/// Planes "place_k": the facet in whose place the k-th surface is, another where that is a level of
/// a texture. The weights of surfaces in one place are the texture's shares.
void add_places(const TextureLevels& levels, int surfaces, Frame& frame) {
    for (int k = 1; k <= surfaces; ++k) {
        Plane plane = frame[fmt::format("facet_{}", k)];
        plane.name = fmt::format("place_{}", k);
        for (float& facet : plane.pixel) {
            if (facet < 0.0f) continue;
            const SurfaceId surface = surface_id(static_cast<std::size_t>(facet));
            facet = static_cast<float>(index(levels.facet_of(surface)));
        }
        frame.planes.push_back(std::move(plane));
    }
}

/// [K] Error of the tables and interreflections of a picture: a tenth of `tolerance_K`.
double table_tolerance(const Scene& scene) { return std::clamp(0.1 * scene.tolerance, 1e-3, 1e-2); }

}  // namespace

Plane void_plane(const View& view, const World& world) {
    Plane plane{"void", "1", std::vector<float>(view.pixels(), -1.0f)};
    for (std::size_t p = 0; p < plane.pixel.size(); ++p) {
        if (view.centre[p] != no_facet) plane.pixel[p] = world.filled[index(view.centre[p])];
    }
    return plane;
}

Picture picture_at(const Prepared& prepared, const Series& s, const FacetViews& views,
                   const TemperatureField& field, Instant instant, bool blurred) {
    const World& world = prepared.world;
    const LightSource light =
        light_source(sun_over(prepared, instant), world.site, instant, lit_bands(s));
    const SunPosition& sun = light.place;
    const std::vector<float> temperature = field.interpolate(instant);
    const Atmosphere atmosphere = light_at(prepared, instant).air;
    const std::vector<SurfaceCover> cover = field.cover_at(instant);
    const std::optional<MaterialLibrary> measured = measured_materials(prepared, instant);
    const MaterialLibrary& materials = measured ? *measured : prepared.scene.materials;
    const std::optional<CoveredSurfaces> covered =
        covered_surfaces(world.surfaces(), materials, field.water.facet, cover);
    const std::vector<float> fraction =
        sun_on_surfaces(prepared, sun, prepared.scene.sun_samples,
                        covered || measured ? std::span<const SurfaceId>() : s.lit.facet);
    const std::optional<FarGround> border =
        far_ground(world, covered ? covered->facets : world.surfaces(), temperature, views.sky);
    RadianceInput now{.facets = covered ? covered->facets : world.surfaces(),
                      .views = views,
                      .materials = covered ? covered->materials : materials,
                      .atmosphere = atmosphere,
                      .temperature = temperature,
                      .sun_fraction = fraction,
                      .to_sun = sun_direction(sun),
                      .sun_zenith_deg = 90.0 - sun.elevation_deg,
                      .sun_distance_au = sun.distance_au,
                      .ground_height_km = world.sea_level_height / 1000.0,
                      .instant = instant,
                      .moon = light.moon,
                      .wind_speed = wind_at(prepared, instant),
                      .beyond = seen_beyond(s.view, border, world.sea_level_height / 1000.0)};
    set_light_heights(prepared, now);
    SunOverFacets over{prepared.rays, world.surfaces(), fraction, now.to_sun};
    std::vector<float> before, after;
    if (blurred) {
        before = sun_on_surfaces(prepared, sun, prepared.scene.sun_samples, {}, 0.0f);
        after = sun_on_surfaces(prepared, sun, prepared.scene.sun_samples, {}, 1.0f);
        over.also = {before, after};
    }
    RememberedSun remembered;
    if (!light.moon && !blurred) {
        remembered = remembered_sun(prepared, views, fraction, s.beside_seen, instant);
    }
    if (!remembered.empty()) {
        over.also = remembered.moments();
        over.past = &remembered.past;
    }
    PixelSun pixel_sun = cast_pixel_sun(s.view, over, s.observer, s.sampling);
    if (!light.moon) {
        set_pixel_heat(s.view, over, materials, temperature, s.sampling.texture_levels, pixel_sun);
    }
    const LinearFacets ground =
        linear_facets(s.view, s.observer, s.fits,
                      {.sun = over,
                       .temperature = temperature,
                       .lit = covered || measured ? std::span<const SurfaceId>() : s.lit.facet});
    const double tolerance = table_tolerance(prepared.scene);
    Frame frame = render(s.view, s.observer, s.bands, now,
                         {.truth = true,
                          .terms = s.input.terms,
                          .surfaces = s.input.surfaces,
                          .tolerance = tolerance,
                          .lit = covered || measured ? nullptr : &s.lit,
                          .secondary_rays = &s.secondary_rays,
                          .pixel_sun = &pixel_sun,
                          .ground = &ground,
                          .plumes = prepared.plumes});
    check_finite(frame, s.input.bands);
    frame.notes["local_time"] = format_local(instant, prepared.scene.time.utc_offset);
    frame.notes["solar_time"] = format_solar_time(world.site, instant);
    if (light.moon) frame.notes["moon"] = moon_note(light);
    if (covered) {
        name_as_dry(*covered, frame);
        frame.notes["water"] = covered->note();
    }
    if (!field.water.empty()) add_cover_planes(s.view, field.water.facet, cover, frame);
    if (!world.filled.empty()) frame.planes.push_back(void_plane(s.view, world));
    add_places(world.texture_levels, s.input.surfaces, frame);
    const CameraTags camera = camera_tags(prepared, s.observer, instant);
    Facts facts = camera_facts(world, s.observer);
    facts.merge(instant_facts(prepared, instant));
    frame.attributes.insert(facts.begin(), facts.end());
    for (const Plane& plane : s.behind) frame.planes.push_back(plane);
    std::vector<Cube> cubes;
    for (const CubeSeries& cube : s.cubes) {
        const Frame channels = render(s.view, s.observer, cube.channels, now,
                                      {.truth = false,
                                       .terms = false,
                                       .tolerance = tolerance,
                                       .lit = covered || measured ? nullptr : &cube.lit,
                                       .secondary_rays = &s.secondary_rays,
                                       .pixel_sun = &pixel_sun,
                                       .ground = &ground,
                                       .plumes = prepared.plumes});
        cubes.push_back(cube_of(channels, cube.channels));
    }
    const double by_samples =
        sample_error(prepared, s, views, frame, temperature, ground, pixel_sun);
    return {std::move(frame), std::move(cubes), std::move(facts), camera, by_samples};
}

}  // namespace diurna
