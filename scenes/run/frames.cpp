#include "scenes/run/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <map>
#include <span>
#include <stdexcept>

#include "materials/base/parallel.hpp"
#include "render/picture/cube.hpp"
#include "render/picture/exr.hpp"
#include "render/picture/quicklook.hpp"
#include "render/rays/follow_rays.hpp"
#include "render/tracer.hpp"
#include "render/view/cast_view.hpp"
#include "scenes/report/annotations.hpp"
#include "scenes/run/appearances.hpp"
#include "scenes/world/air.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/sun_fraction.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

std::string base_name(const std::string& observer, const std::string& band, Instant instant) {
    Frame named;
    named.observer = observer;
    named.instant = instant;
    return "frames/" + frame_name(named, band);
}

/// The files of one frame: for every band and every cube.
std::vector<std::string> files_of(const ObserverInput& observer, Instant instant) {
    std::vector<std::string> files;
    for (const std::string& band : observer.bands) {
        const std::string name = base_name(observer.name, band, instant);
        files.push_back(name + ".exr");
        files.push_back(name + ".png");
    }
    for (const std::string& cube : observer.cubes) {
        const std::string name = base_name(observer.name, cube, instant);
        for (const char* extension : {".exr", ".img", ".hdr"}) files.push_back(name + extension);
    }
    return files;
}

/// All of them are there.
bool complete(const fs::path& out, const ObserverInput& observer, Instant instant) {
    const std::vector<std::string> files = files_of(observer, instant);
    return std::all_of(files.begin(), files.end(),
                       [&](const std::string& file) { return fs::exists(out / file); });
}

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

const CubeInput& named_cube(const Scene& scene, const std::string& name) {
    return *std::find_if(scene.cubes.begin(), scene.cubes.end(),
                         [&](const CubeInput& cube) { return cube.name == name; });
}

/// What stays of a cube from frame to frame.
struct CubeWork {
    std::string name;
    std::vector<Band> channels;
    LitFacets lit;
};

/// In the spectral OpenEXR layout and for ENVI.
void write_cube(const fs::path& base, const Cube& cube) {
    write_exr(base.string() + ".exr", spectral_frame(cube), ExrCompression::piz);
    write_envi(base.string() + ".img", cube);
}

void write_frame(const fs::path& out, const Frame& frame, const std::vector<Band>& bands) {
    for (const Band& band : bands) {
        const std::string name = base_name(frame.observer, band.name, frame.instant);
        const Frame one = band_frame(frame, band.name);
        write_exr(out / (name + ".exr"), one);
        write_quicklook(out / (name + ".png"), one, shown_plane(band));
    }
}

/// Of all frames' notes of one name, which begin with a number, that of the greatest.
std::string worst_note(std::span<const std::map<std::string, std::string>> notes,
                       const std::string& name) {
    std::string worst;
    double most = -1.0;
    for (const auto& of_frame : notes) {
        const auto note = of_frame.find(name);
        if (note == of_frame.end()) continue;
        const double value = std::strtod(note->second.c_str(), nullptr);
        if (value > most) {
            most = value;
            worst = note->second;
        }
    }
    return worst;
}

}  // namespace

std::vector<std::string> frame_files(const Prepared& prepared) {
    std::vector<std::string> files;
    for (const ObserverInput& observer : prepared.scene.observers) {
        for (const Instant instant : prepared.plan.frames) {
            const std::vector<std::string> some = files_of(observer, instant);
            files.insert(files.end(), some.begin(), some.end());
        }
    }
    return files;
}

Plane void_plane(const View& view, const World& world) {
    Plane plane{"void", "1", std::vector<float>(view.pixels(), -1.0f)};
    for (std::size_t p = 0; p < plane.pixel.size(); ++p) {
        if (view.centre[p] != no_facet) plane.pixel[p] = world.filled[index(view.centre[p])];
    }
    return plane;
}

std::size_t render_frames(const Prepared& prepared, const FacetViews& views,
                          const TemperatureField& field, const fs::path& out, Progress& progress,
                          std::vector<std::string>* errors) {
    const Scene& scene = prepared.scene;
    const World& world = prepared.world;
    const FacetSet& surfaces = world.surfaces();
    std::size_t rendered = 0;
    for (std::size_t o = 0; o < scene.observers.size(); ++o) {
        const ObserverInput& input = scene.observers[o];
        const Observer& observer = prepared.observers[o];
        std::vector<Instant> wanted;
        for (const Instant instant : prepared.plan.frames) {
            if (!complete(out, input, instant)) wanted.push_back(instant);
        }
        if (wanted.empty()) continue;

        progress.stage("cast view of " + input.name);
        const ViewOptions sampling{
            .samples = input.samples, .seed = scene.seed, .texture_levels = &world.texture_levels};
        std::vector<Band> bands;
        for (const std::string& band : input.bands)
            bands.push_back(named_band(scene.bands, band, bin_edges_um()));
        View view = input.adaptive ? cast_adaptive_view(prepared.rays, surfaces, observer,
                                                        appearances(prepared, views, field, bands),
                                                        *input.adaptive, sampling)
                                   : cast_view(prepared.rays, surfaces, observer, sampling);
        const PlumeScene plumes(prepared.plumes);
        const Hops hops = follow_rays(view, {prepared.rays, surfaces, scene.materials, plumes},
                                      observer, sampling);

        const RadianceInput still{.facets = surfaces,
                                  .views = views,
                                  .materials = scene.materials,
                                  .atmosphere = Vacuum{},
                                  .temperature = {},
                                  .ground_height_km = world.sea_level_height / 1000.0};
        const LitFacets lit = lit_facets(still, view.facet, bands);
        std::vector<CubeWork> cubes;
        for (const std::string& name : input.cubes) {
            const CubeInput& cube = named_cube(scene, name);
            CubeWork work{
                name, channel_bands(cube.from_um, cube.to_um, cube.channels, bin_edges_um()), {}};
            work.lit = lit_facets(still, view.facet, work.channels);
            cubes.push_back(std::move(work));
        }
        progress.stage("frames of " + input.name);
        std::atomic<std::size_t> done = 0;
        std::vector<std::map<std::string, std::string>> notes(wanted.size());
        const auto render_one = [&](std::size_t i) {
            const Instant instant = wanted[i];
            const SunPosition sun = sun_position(world.site, instant);
            std::vector<float> fraction;
            if (sun.elevation_deg > 0.0) {
                fraction.resize(world.facets.size());
                sun_fraction(world.facets, prepared.rays, sun_direction(sun), fraction,
                             {.samples = scene.sun_samples, .seed = scene.seed});
                if (!world.texture_levels.empty())
                    fraction = for_all_levels(world.texture_levels, fraction);
            }
            const std::vector<float> temperature = field.interpolate(instant);
            const Atmosphere atmosphere = atmosphere_at(scene, world, prepared.weather, instant);
            const RadianceInput now{.facets = surfaces,
                                    .views = views,
                                    .materials = scene.materials,
                                    .atmosphere = atmosphere,
                                    .temperature = temperature,
                                    .sun_fraction = fraction,
                                    .to_sun = sun_direction(sun),
                                    .sun_zenith_deg = 90.0 - sun.elevation_deg,
                                    .sun_distance_au = sun.distance_au,
                                    .ground_height_km = world.sea_level_height / 1000.0,
                                    .instant = instant};
            Frame frame = render(view, observer, bands, now,
                                 {.truth = true,
                                  .terms = input.terms,
                                  .lit = &lit,
                                  .hops = &hops,
                                  .plumes = prepared.plumes});
            check_finite(frame, input.bands);
            notes[i] = frame.notes;
            if (!world.filled.empty()) frame.planes.push_back(void_plane(view, world));
            write_frame(out, frame, bands);
            for (const CubeWork& cube : cubes) {
                write_cube(out / base_name(input.name, cube.name, instant),
                           cube_of(render(view, observer, cube.channels, now,
                                          {.truth = false,
                                           .terms = false,
                                           .lit = &cube.lit,
                                           .hops = &hops,
                                           .plumes = prepared.plumes}),
                                   cube.channels));
            }
            progress.done(static_cast<double>(++done) / static_cast<double>(wanted.size()));
        };
        for_each_index(wanted.size(), render_one, 1);
        rendered += wanted.size();
        for (const std::string& band : input.bands) {
            if (errors == nullptr) break;
            std::string line = input.name + ", " + band + ": ";
            line += worst_note(notes, "error." + band);
            const std::string scattered = worst_note(notes, "scattered." + band);
            if (!scattered.empty()) line += "; light scattered before surfaces " + scattered;
            errors->push_back(std::move(line));
        }
    }
    return rendered;
}

void annotate_frames(const Prepared& prepared, const fs::path& out) {
    const Scene& scene = prepared.scene;
    std::vector<std::vector<ObjectMask>> masks;  // (observer)
    for (const ObserverInput& observer : scene.observers) {
        const Instant first = prepared.plan.frames.front();
        masks.push_back(object_masks(
            read_exr(out / (base_name(observer.name, observer.bands.front(), first) + ".exr"))));
    }
    std::vector<Annotated> images;
    for (std::size_t o = 0; o < scene.observers.size(); ++o) {
        const ObserverInput& observer = scene.observers[o];
        for (const Instant instant : prepared.plan.frames) {
            for (const std::string& band : observer.bands) {
                images.push_back({.file = base_name(observer.name, band, instant) + ".exr",
                                  .instant = instant,
                                  .observer = observer.name,
                                  .width = observer.width,
                                  .height = observer.height,
                                  .masks = &masks[o]});
            }
        }
    }
    write_annotations(out, images, prepared.world.objects);
}

}  // namespace diurna
