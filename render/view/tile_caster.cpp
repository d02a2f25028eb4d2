#include "render/view/tile_caster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "materials/air/sight_line.hpp"
#include "render/view/pixel_samples.hpp"
#include "render/view/sky_angles.hpp"
#include "render/view/textured_hit.hpp"

namespace diurna {

namespace {

constexpr std::size_t block = 4, lanes = RayBundles::lanes;
constexpr auto bend = static_cast<float>(1.0 / (2e3 * earth_radius_km));  // [1/m]

/// Heights above the level surface of what rays meet [m].
void levels(const RayBundles& rays, std::size_t bundles, float* level) {
#pragma omp simd
    for (std::size_t s = 0; s < bundles * lanes; ++s) {
        const float px = rays.origin_x[s] + rays.range[s] * rays.direction_x[s];
        const float py = rays.origin_y[s] + rays.range[s] * rays.direction_y[s];
        level[s] =
            rays.origin_z[s] + rays.range[s] * rays.direction_z[s] + bend * (px * px + py * py);
    }
}

Eigen::Vector3d origin_of(const RayBundles& rays, std::size_t ray) {
    return {rays.origin_x[ray], rays.origin_y[ray], rays.origin_z[ray]};
}
Eigen::Vector3d direction_of(const RayBundles& rays, std::size_t ray) {
    return {rays.direction_x[ray], rays.direction_y[ray], rays.direction_z[ray]};
}

/// Range to the plane of the facet that a ray meets: Embree's float is off by up to 2e-5, but that
/// of the facet beside it by no more than its corners.
float refined(const RayBundles& rays, std::size_t ray, const FacetSet& facets,
              const Copies& copies) {
    const auto [f, copy] = copies.at(rays.facet[ray]);
    const Eigen::Vector3d to = direction_of(rays, ray);
    const double range = rays.range[ray];
    const Eigen::Vector3d normal = copies.turned(copy, facets.normal[f].cast<double>());
    const double descent = normal.dot(to);
    if (!(std::abs(descent) > 0.05)) return rays.range[ray];  // recomputed already
    const Eigen::Vector3d beside =
        copies.placed(copy, facets.centroid[f].cast<double>()) - origin_of(rays, ray) - range * to;
    return static_cast<float>(range + normal.dot(beside) / descent);
}

/// Copies have no textures.
Blend blend_of(const TexturedHit& textured, const RayBundles& rays, std::size_t ray, float range) {
    const std::uint32_t met = rays.facet[ray];
    if (Copies::is_copied(met)) return {SurfaceId{met}, SurfaceId{met}};
    return textured.at(FacetId{met}, origin_of(rays, ray), direction_of(rays, ray), double{range});
}

/// At the middle of four rays that meet one facet.
Blend middle_blend(const TexturedHit& textured, const RayBundles& rays, std::size_t first,
                   const std::array<std::size_t, 4>& of) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero(), towards = Eigen::Vector3d::Zero();
    double range = 0.0;
    for (const std::size_t k : of) {
        const std::size_t ray = first + k;
        place += 0.25 * (origin_of(rays, ray) + double{rays.range[ray]} * direction_of(rays, ray));
        towards += 0.25 * direction_of(rays, ray);
        range += 0.25 * double{rays.range[ray]};
    }
    return textured.over(FacetId{rays.facet[first + of[0]]}, place, towards, range, 2.0);
}

/// As group_samples() of a bundle, but samples on textured facets count for the two that each is a
/// mixture of: room for two groups a lane. Where four that stand in a square meet one facet, their
/// mixture is that at their middle, over a place twice as wide: a fourth of the work.
///
/// - columns: of a pixel's samples, where a bundle holds whole squares of them; else 0
std::size_t group_textured(const TexturedHit& textured, const RayBundles& rays, std::size_t bundle,
                           const float* level, std::size_t used, std::size_t columns,
                           SampleGroup* groups) {
    std::size_t size = 0;
    const auto add = [&](SurfaceId surface, std::uint32_t parts, std::size_t ray, float height) {
        if (parts == 0) return;
        const double samples = double(parts) / one_sample;
        groups[size] = {number(surface), parts, samples * double{rays.range[ray]},
                        samples * double{height}};
        size = merge_groups(groups, size, 1);
    };
    const std::size_t first = bundle * lanes;
    const auto add_blend = [&](const Blend& blend, std::size_t s) {
        const auto second =
            static_cast<std::uint32_t>(std::lround(blend.second_share * float{one_sample}));
        add(blend.first, one_sample - second, first + s, level[s]);
        add(blend.second, second, first + s, level[s]);
    };
    std::array<Blend, lanes> of_square;  // at the lanes of a square whose first has been met
    std::uint32_t known = 0;
    for (std::size_t s = 0; s < used; ++s) {
        const std::size_t ray = first + s;
        if (rays.facet[ray] == index(no_facet)) continue;
        if ((known >> s & 1u) == 0) {
            const std::array<std::size_t, 4> square = {s, s + 1, s + columns, s + columns + 1};
            const bool begins = columns > 0 && s % 2 == 0 && s / columns % 2 == 0;
            const bool one = begins && square[3] < used && !Copies::is_copied(rays.facet[ray]) &&
                             std::all_of(square.begin(), square.end(), [&](std::size_t k) {
                                 return rays.facet[first + k] == rays.facet[ray];
                             });
            if (one) {
                const Blend blend = middle_blend(textured, rays, first, square);
                for (const std::size_t k : square) {
                    of_square[k] = blend;
                    known |= 1u << k;
                }
            } else {
                of_square[s] = blend_of(textured, rays, ray, rays.range[ray]);
            }
        }
        add_blend(of_square[s], s);
    }
    return size;
}

}  // namespace

class TileCaster::State {
 public:
    State(const RayScene& scene, const FacetSet& facets, const Observer& observer,
          const ViewOptions& options, View& view)
        : scene_(scene),
          facets_(facets),
          samples_(observer, options.samples, options.seed),
          square_columns_(samples_.columns() % 2 == 0 && lanes % (2 * samples_.columns()) == 0
                              ? samples_.columns()
                              : 0),
          azimuth_deg_(observer.azimuth_deg),
          share_(1.0f / static_cast<float>(options.samples)),
          asked_(options.asked),
          view_(view) {
        if (options.texture_levels != nullptr && !options.texture_levels->empty()) {
            textured_.emplace(*options.texture_levels, observer, options.samples);
            view.centre_blend.assign(view.pixels(), {own_surface(no_facet), own_surface(no_facet)});
        }
    }

    void cast(std::size_t begin, std::size_t end, std::vector<TileView>& tiles) const {
        Work work(scene_, samples_);
        for (std::size_t t = begin; t < end; ++t) {
            work.gatherer.start_tile();
            work.sky = {};
            std::size_t place = 0;
            const Area all = tile_area(view_, t);
            each_block(all, [&](const Area& area) {
                cast_samples(area, place, work);
                if (asked_.empty()) cast_middles(area, work.rays);
                place += area.size();
            });
            TileView& out = tiles[t];
            out.sightings = work.gatherer.finish_tile(all.size());
            for (std::size_t k = 0; k < out.sightings.met.size(); ++k) {
                out.near = std::min(out.near, out.sightings.range[k]);
                out.far = std::max(out.far, out.sightings.range[k]);
                out.low = std::min(out.low, out.sightings.height[k]);
                out.high = std::max(out.high, out.sightings.height[k]);
            }
            out.sky = note_sky(work.sky);
        }
    }

 private:
    /// What one thread needs.
    struct Work {
        static constexpr std::size_t most = block * block;  // bundles at a time
        RayBundles rays;
        TileGatherer gatherer;
        SkyDirections sky;
        std::vector<SampleGroup> groups;  // of a pixel
        alignas(64) std::array<float, most * lanes> level;

        // Of a pixel that is being put together from bundles.
        std::size_t size = 0;  // groups
        std::uint32_t open = 0;
        std::array<float, 3> towards{};

        Work(const RayScene& scene, const PixelSamples& samples)
            : rays(scene, most), groups(2 * lanes * samples.bundles()) {
            rays.set_origin(samples.origin());
        }
    };

    /// `place`: of the area's first pixel in its tile.
    void cast_samples(const Area& area, std::size_t place, Work& work) const {
        const std::size_t parts = samples_.bundles();
        const auto width = static_cast<std::size_t>(view_.width);
        struct Bundle {
            std::uint32_t pixel, place, part;
        };
        std::array<Bundle, Work::most> bundles;
        std::size_t count = 0;
        const auto cast = [&] {
            work.rays.closest(count);
            levels(work.rays, count, work.level.data());
            for (std::size_t k = 0; k < count; ++k) {
                gather(k, bundles[k].part, work);
                if (bundles[k].part + 1 == parts) {
                    finish_pixel(bundles[k].pixel, bundles[k].place, work);
                }
            }
            count = 0;
        };
        each_pixel(area, [&](std::size_t x, std::size_t y) {
            const std::size_t pixel = y * width + x;
            if (asked_.empty() || asked_[pixel] != 0) {
                for (std::size_t part = 0; part < parts; ++part) {
                    samples_.aim(x, y, part, count, work.rays);
                    bundles[count] = {static_cast<std::uint32_t>(pixel),
                                      static_cast<std::uint32_t>(place),
                                      static_cast<std::uint32_t>(part)};
                    if (++count == Work::most) cast();
                }
            }
            ++place;
        });
        if (count > 0) cast();
    }

    /// Adds a bundle to its pixel.
    void gather(std::size_t at, std::size_t part, Work& work) const {
        const std::size_t lane = at * lanes, used = samples_.used(part);
        const float* level = work.level.data() + lane;
        SampleGroup* more = work.groups.data() + work.size;
        std::size_t found =
            group_samples(work.rays.facet + lane, work.rays.range + lane, level, used, more);
        std::size_t hits = 0;
        for (std::size_t g = 0; g < found; ++g) hits += more[g].parts / one_sample;
        if (hits < used) work.open += add_open_lanes(work.rays, at, used, work.towards.data());
        if (textured_)
            found = group_textured(*textured_, work.rays, at, level, used, square_columns_, more);
        work.size = part == 0 ? found : merge_groups(work.groups.data(), work.size, found);
    }

    void finish_pixel(std::size_t pixel, std::size_t place, Work& work) const {
        work.gatherer.add_pixel(place, {work.groups.data(), work.size}, share_);
        if (work.open > 0) {
            const std::size_t width = std::size_t(view_.width);
            const Eigen::Vector3d middle =
                samples_.eye().towards(double(pixel % width) + 0.5, double(pixel / width) + 0.5);
            work.sky.add(pixel, work.towards.data(), middle,
                         static_cast<float>(work.open) * share_);
        }
        work.size = work.open = 0;
        work.towards = {};
    }

    void cast_middles(const Area& area, RayBundles& rays) const {
        static_assert(block * block == lanes);
        samples_.aim_middles(area.x0, area.y0, 0, rays);
        rays.closest(1);
        each_pixel(area, [&](std::size_t x, std::size_t y) {
            const std::size_t ray = (y - area.y0) * block + x - area.x0;
            if (rays.facet[ray] == index(no_facet)) return;
            const std::size_t pixel = y * std::size_t(view_.width) + x;
            const auto [facet, copy] = view_.copies.at(rays.facet[ray]);
            view_.centre[pixel] = FacetId{facet};
            view_.centre_range[pixel] = refined(rays, ray, facets_, view_.copies);
            if (copy != no_copy) {
                view_.centre_copy[pixel] = copy;
                if (textured_) view_.centre_blend[pixel] = {SurfaceId{facet}, SurfaceId{facet}};
            } else if (textured_) {
                view_.centre_blend[pixel] =
                    blend_of(*textured_, rays, ray, view_.centre_range[pixel]);
            }
        });
    }

    SkyExtent note_sky(const SkyDirections& sky) const {
        std::vector<float> zenith, azimuth;
        sky_angles(sky, azimuth_deg_, zenith, azimuth);
        SkyExtent extent;
        for (std::size_t k = 0; k < sky.size(); ++k) {
            view_.sky[sky.pixel[k]] = sky.share[k];
            view_.sky_zenith_deg[sky.pixel[k]] = zenith[k];
            view_.sky_azimuth_deg[sky.pixel[k]] = azimuth[k];
            extent.add(zenith[k], azimuth[k]);
        }
        return extent;
    }

    const RayScene& scene_;
    const FacetSet& facets_;
    PixelSamples samples_;
    std::size_t square_columns_;  // of samples, where bundles hold whole squares of them; else 0
    double azimuth_deg_;
    float share_;
    std::span<const std::uint8_t> asked_;
    std::optional<TexturedHit> textured_;
    View& view_;
};

TileCaster::TileCaster(const RayScene& scene, const FacetSet& facets, const Observer& observer,
                       const ViewOptions& options, View& view)
    : state_(std::make_unique<State>(scene, facets, observer, options, view)) {}

TileCaster::~TileCaster() = default;

void TileCaster::cast(std::size_t begin, std::size_t end, std::vector<TileView>& tiles) const {
    state_->cast(begin, end, tiles);
}

}  // namespace diurna
