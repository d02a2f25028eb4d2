#include "render/tracer.hpp"

#include <fmt/format.h>

#include <optional>

#include "materials/base/error.hpp"
#include "render/eye/apparent_temperature.hpp"
#include "render/eye/eye_tables.hpp"
#include "render/eye/linear_facets_sum.hpp"
#include "render/eye/pixel_sum.hpp"
#include "render/eye/pixel_sun_sum.hpp"
#include "render/eye/surface_planes.hpp"
#include "render/eye/truth.hpp"
#include "render/light/reused_floats.hpp"
#include "render/light/scene_light.hpp"
#include "render/path/path_table.hpp"
#include "render/path/view_backgrounds.hpp"
#include "render/path/view_scattered_path.hpp"
#include "render/rays/secondary_light.hpp"

namespace diurna {

namespace {

using Planes = std::vector<std::vector<float>>;  // (column)(pixel); columns as in EyeTables

void check_sizes(const View& view, const RadianceInput& input) {
    const std::size_t n = input.facets.size();
    const auto expect = [n](const char* what, std::size_t size) {
        if (size != n) {
            throw InputError("render",
                             fmt::format("{} has {} entries for {} facets", what, size, n));
        }
    };
    expect("temperature", input.temperature.size());
    if (!input.sun_fraction.empty()) expect("sun_fraction", input.sun_fraction.size());
    expect("sky_view", input.views.sky.size());
    if (input.views.others.row.size() != n + 1) {
        throw InputError("render", "the exchange rows do not match the facets");
    }
    if (view.facets > n) {
        throw InputError("render", "the view was traced with other facets");
    }
}

void check_pixel_sun(const PixelSun& sun, const View& view) {
    if (!sun.sighting.empty() && sun.sighting.back() >= view.sighting.size()) {
        throw InputError("render", "the sun visibility of pixels belongs to another view");
    }
}

void check_ground(const LinearFacets& ground, const View& view) {
    if (!ground.empty() && ground.warmer.size() != view.sighting.size()) {
        throw InputError("render", "the temperatures within facets belong to another view");
    }
}

void check_lit(const LitFacets& lit, std::size_t seen, std::size_t bands) {
    if (lit.bounds.size() != bands || lit.target.size() != seen) {
        throw InputError("render", "the illuminated facets belong to another view or other bands");
    }
}

Frame empty_frame(const View& view, const Observer& observer, const RadianceInput& input) {
    Frame frame;
    frame.width = view.width;
    frame.height = view.height;
    frame.instant = input.instant;
    frame.observer = observer.name;
    return frame;
}

/// Radiance of facets and of what is seen where the scene ends, pixel by pixel.
Planes see(const View& view, const Observer& observer, const EyeTables& tables,
           const SceneLight& light) {
    const std::size_t columns = tables.columns(), per_band = tables.columns_of_band();
    static_assert(sizeof(AtEye) == 3 * sizeof(float));
    ReusedFloats memory(view.surface.size() * columns * 3);
    const std::span eye(reinterpret_cast<AtEye*>(memory.data()), view.surface.size() * columns);
    tables.look(view, light, eye);
    // What is seen where the scene ends is air, or ends in air: it counts as path, the last term.
    const auto behind = view_backgrounds(view, observer, light.band, light.input);
    std::vector<const BackgroundTable*> background(columns, nullptr);
    for (std::size_t b = 0; b < behind.size(); ++b) {
        background[(b + 1) * per_band - 1] = &behind[b];
    }
    Planes planes(columns, std::vector<float>(view.pixels()));
    sum_pixels(view, eye, background, axis_from_sun_deg(observer, light.input), planes);
    return planes;
}

/// The columns of band b.
std::span<std::vector<float>> of_band(Planes& planes, std::size_t b, std::size_t bands) {
    const std::size_t per_band = planes.size() / bands;
    return std::span(planes).subspan(b * per_band, per_band);
}

/// Sunlight scattered by the air before the facets: it counts as path.
void add_scattered(const View& view, const Observer& observer, const SceneLight& light,
                   Planes& planes, Frame& frame) {
    for (std::size_t b = 0; b < light.band.size(); ++b) {
        const BandLight& band = light.band[b];
        if (!band.scattered) continue;
        frame.notes["scattered." + band.band.name] = add_scattered_paths(
            view, observer, light.input, band, of_band(planes, b, light.band.size()).back());
    }
}

std::vector<float> sum_of(std::span<const std::vector<float>> planes) {
    std::vector<float> sum(planes[0].size());
    for (std::size_t p = 0; p < sum.size(); ++p) {
        double total = 0.0;
        for (const auto& plane : planes) total += double{plane[p]};
        sum[p] = static_cast<float>(total);
    }
    return sum;
}

/// A band's radiance, its apparent temperature and, where there are several, its terms.
void add_planes(const Band& band, std::span<std::vector<float>> terms, Frame& frame) {
    const bool by_term = terms.size() > 1;
    std::vector<float> radiance = by_term ? sum_of(terms) : std::move(terms[0]);
    std::vector<float> temperature = apparent_temperature(band, radiance);
    frame.planes.push_back({"radiance." + band.name, "W m-2 sr-1", std::move(radiance)});
    frame.planes.push_back({"apparent_temperature." + band.name, "K", std::move(temperature)});
    for (std::size_t t = 0; by_term && t < term_count; ++t) {
        frame.planes.push_back(
            {fmt::format("{}.{}", term_names[t], band.name), "W m-2 sr-1", std::move(terms[t])});
    }
}

/// Band, error estimate, size of the grid, and a bound on what is skipped.
void add_notes(std::size_t b, const SceneLight& light, const PathTable& path, const EyeGrid& eye,
               Frame& frame) {
    const BandLight& of = light.band[b];
    const std::string& name = of.band.name;
    frame.notes["band." + name] =
        fmt::format("{:g} to {:g} um", of.band.from_um(), of.band.to_um());
    frame.notes["error." + name] = fmt::format(
        "interpolation error {:.2g} mK; {} ranges and {} heights computed, subdivided into {} and "
        "{} for linear interpolation; {} modes ({} thermal) for {} channels",
        1e3 * (path.error(b) + eye.error), path.grid().ranges, path.grid().heights, eye.ranges,
        eye.heights, of.basis.size(), of.basis.thermal, of.channels.size());
    frame.notes["bounces." + name] = fmt::format(
        "{} reflections computed, the second at {} of {} facets; the remainder is at most {:.2g} W "
        "m-2 sr-1",
        light.radiosity.bounces(), light.radiosity.followed(), light.lit.facet.size(),
        left_over(of, light.state.extent, light.lit.bounds[b], light.bounces[b]));
}

}  // namespace

Frame render(const View& view, const Observer& observer, std::span<const Band> bands,
             const RadianceInput& input, const FrameOptions& options) {
    check_sizes(view, input);
    if (options.pixel_sun) check_pixel_sun(*options.pixel_sun, view);
    if (options.ground) check_ground(*options.ground, view);
    Frame frame = empty_frame(view, observer, input);
    if (!bands.empty()) {
        // Light the facets that the picture depends on.
        std::optional<LitFacets> own;
        const bool secondary_rays = options.secondary_rays && !options.secondary_rays->empty();
        const std::vector<SurfaceId> seen =
            secondary_rays ? seen_surfaces(view.surface, *options.secondary_rays) : view.surface;
        if (!options.lit) own = lit_facets(input, seen, bands);
        const LitFacets& lit = options.lit ? *options.lit : *own;
        check_lit(lit, seen.size(), bands.size());
        const SceneLight light(input, lit, bands, options.bounces, options.tolerance);

        // See them, and what is behind them, through the air.
        const PathTable path(input, path_extent(view, input.ground_height_km), light.band,
                             options.tolerance);
        const EyeTables eye(path, light,
                            {.by_term = options.terms || options.surfaces > 0,
                             .tolerance = 0.5 * options.tolerance});
        Planes planes = see(view, observer, eye, light);
        if (options.pixel_sun) {
            add_pixel_sun(view, *options.pixel_sun, light, eye, planes);
            add_pixel_heat(view, *options.pixel_sun, light, eye, planes);
        }
        if (options.ground) add_linear_facets(view, *options.ground, light, eye, planes);
        add_scattered(view, observer, light, planes, frame);

        // Follow the rays that go through panes, nets and plumes and off mirrors.
        std::optional<SecondaryLight> of_secondary_rays;
        if (secondary_rays) {
            of_secondary_rays.emplace(*options.secondary_rays, options.plumes, light,
                                      view.surface.size(),
                                      SecondaryOptions{.bounces = options.bounces,
                                                       .tolerance = options.tolerance,
                                                       .by_term = eye.columns_of_band() > 1,
                                                       .path = &path});
            of_secondary_rays->add(planes);
        }

        // Write what has been found.
        for (std::size_t b = 0; b < bands.size(); ++b) {
            add_planes(bands[b], of_band(planes, b, bands.size()), frame);
            add_notes(b, light, path, eye.grid(), frame);
        }
        if (options.surfaces > 0) {
            add_surface_planes(view, light, eye, options.pixel_sun, options.ground,
                               static_cast<std::size_t>(options.surfaces), frame);
            if (secondary_rays)
                of_secondary_rays->add_surfaces(static_cast<std::size_t>(options.surfaces), frame);
        }
    }
    if (options.truth) add_truth(view, input, options.pixel_sun, options.ground, frame);
    return frame;
}

}  // namespace diurna
