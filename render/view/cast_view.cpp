#include "render/view/cast_view.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <span>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "render/view/tile_caster.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

/// Of positive numbers, within 2 units in the last place: two of Halley's steps from a third of the
/// exponent.
void cube_roots(std::span<const float> of, float* root) {
#pragma omp simd
    for (std::size_t k = 0; k < of.size(); ++k) {
        const float a = of[k];
        float y = std::bit_cast<float>(std::bit_cast<std::uint32_t>(a) / 3u + 0x2A51'4067u);
        for (int step = 0; step < 2; ++step) {
            const float cube = y * y * y;
            y *= (cube + 2.0f * a) / (2.0f * cube + a);
        }
        root[k] = y;
    }
}

/// Sightings in the order of pixels and targets in the order of tiles.
void join(const std::vector<TileView>& tiles, View& view) {
    const auto width = static_cast<std::size_t>(view.width);
    std::vector<std::uint32_t> first(tiles.size() + 1, 0);  // target
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        first[t + 1] = first[t] + static_cast<std::uint32_t>(tiles[t].sightings.met.size());
    }
    view.row.assign(view.pixels() + 1, 0);
    const auto each_of_tile = [&](std::size_t t, const auto& body) {
        each_block(tile_area(view, t), [&](const Area& area) {
            each_pixel(area, [&](std::size_t x, std::size_t y) { body(y * width + x); });
        });
    };
    for_each_index(
        tiles.size(),
        [&](std::size_t t) {
            std::uint32_t begin = 0;
            const std::uint32_t* end = tiles[t].sightings.end.data();
            each_of_tile(t, [&](std::size_t pixel) {
                view.row[pixel + 1] = *end - begin;
                begin = *end++;
            });
        },
        1);
    for (std::size_t p = 0; p < view.pixels(); ++p) view.row[p + 1] += view.row[p];
    view.sighting.resize(view.row.back());
    view.surface.resize(first.back());
    if (!view.copies.empty()) view.copy.resize(first.back(), no_copy);
    view.range.resize(first.back());
    view.range_root.resize(first.back());
    view.target_height.resize(first.back());
    for_each_index(
        tiles.size(),
        [&](std::size_t t) {
            const TileSightings& from = tiles[t].sightings;
            const Sighting* next = from.sighting.data();
            each_of_tile(t, [&](std::size_t pixel) {
                for (std::uint32_t k = view.row[pixel]; k < view.row[pixel + 1]; ++k) {
                    Sighting& s = view.sighting[k];
                    s = *next++;
                    s.target += first[t];
                }
            });
            for (std::size_t k = 0; k < from.met.size(); ++k) {
                const auto [surface, copy] = view.copies.at(from.met[k]);
                view.surface[first[t] + k] = SurfaceId{surface};
                if (!view.copy.empty()) view.copy[first[t] + k] = copy;
            }
            std::copy(from.range.begin(), from.range.end(), &view.range[first[t]]);
            std::copy(from.height.begin(), from.height.end(), &view.target_height[first[t]]);
            cube_roots(from.range, &view.range_root[first[t]]);
        },
        1);
}

ViewExtent extent_of(const std::vector<TileView>& tiles) {
    ViewExtent extent{.near = 1e30f, .far = 0.0f, .low = 1e30f, .high = -1e30f};
    bool any = false;
    for (const TileView& t : tiles) {
        if (t.sightings.met.empty()) continue;
        any = true;
        extent.near = std::min(extent.near, t.near);
        extent.far = std::max(extent.far, t.far);
        extent.low = std::min(extent.low, t.low);
        extent.high = std::max(extent.high, t.high);
    }
    if (!any) extent = {};
    SkyExtent sky;
    for (const TileView& t : tiles) {
        if (t.sky.pixels == 0) continue;
        const std::size_t pixels = sky.pixels + t.sky.pixels;
        sky.add(t.sky.zenith_deg[0], t.sky.azimuth_deg[0]);
        sky.add(t.sky.zenith_deg[1], t.sky.azimuth_deg[1]);
        sky.pixels = pixels;
    }
    extent.sky_pixels = sky.pixels;
    if (sky.pixels > 0) {
        extent.sky_zenith_deg = sky.zenith_deg;
        extent.sky_azimuth_deg = sky.azimuth_deg;
    }
    return extent;
}

}  // namespace

View cast_view(const RayScene& scene, const FacetSet& facets, const Observer& observer,
               const ViewOptions& options) {
    check_observer(observer);
    if (options.samples < 1 || options.samples > 4096) {
        throw InputError("observer " + observer.name, "samples per pixel must be 1 to 4096");
    }
    View view;
    view.width = observer.width;
    view.height = observer.height;
    view.facets = facets.size();
    if (options.texture_levels != nullptr && !options.texture_levels->empty()) {
        view.facets = options.texture_levels->facets.size();
    }
    view.observer_height = level_height(observer.position);
    const std::size_t pixels = std::size_t(view.width) * std::size_t(view.height);
    view.sky.assign(pixels, 0.0f);
    view.sky_zenith_deg.assign(pixels, 0.0f);
    view.sky_azimuth_deg.assign(pixels, 0.0f);
    view.centre.assign(pixels, no_facet);
    view.centre_range.assign(pixels, std::numeric_limits<float>::quiet_NaN());
    view.copies = scene.copies();
    if (!view.copies.empty()) view.centre_copy.assign(pixels, no_copy);
    view.rays = options.asked.empty() ? pixels * (std::size_t(options.samples) + 1)
                                      : std::size_t(options.samples) *
                                            static_cast<std::size_t>(std::count_if(
                                                options.asked.begin(), options.asked.end(),
                                                [](std::uint8_t one) { return one != 0; }));

    const TileCaster caster(scene, facets, observer, options, view);
    std::vector<TileView> tiles(tile_count(view));
    // A few at a time, which share their memory, but enough for many threads.
    for_each_block(tiles.size(), std::clamp<std::size_t>(tiles.size() / 64, 1, 8),
                   [&](std::size_t begin, std::size_t end) { caster.cast(begin, end, tiles); });
    join(tiles, view);
    view.extent = extent_of(tiles);
    return view;
}

}  // namespace diurna
