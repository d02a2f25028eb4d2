#include "render/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "materials/error.hpp"
#include "materials/sight_line.hpp"
#include "materials/units.hpp"
#include "terrain/parallel.hpp"

namespace diurna {

namespace {

/// Two numbers in [0, 1) that depend on the three given ones alone (SplitMix64's finaliser).
std::array<double, 2> jitter(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample) {
    std::uint64_t x = seed * 0x9E3779B97F4A7C15u + pixel * 0xD1B54A32D192ED03u + sample;
    for (int round = 0; round < 2; ++round) {
        x += 0x9E3779B97F4A7C15u;
        x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
        x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
        x ^= x >> 31;
    }
    return {double(x >> 32) * 0x1p-32, double(x & 0xFFFFFFFFu) * 0x1p-32};
}

/// Columns and rows of the grid that has one cell a sample: as square as the number allows.
std::array<int, 2> strata(int samples) {
    int rows = static_cast<int>(std::sqrt(double(samples)));
    while (samples % rows != 0) --rows;
    return {samples / rows, rows};
}

struct Sample {
    FacetId facet;
    float range, height;
};

/// What one row of pixels sees; targets are facet ids until all rows are known.
struct PixelRow {
    std::vector<Sighting> sighting;
    std::vector<std::uint32_t> count;  // (pixel)
};

/// Adds the sightings of one pixel: samples on one facet become one.
void gather(std::span<Sample> samples, float share, PixelRow& row) {
    std::stable_sort(samples.begin(), samples.end(),
                     [](const Sample& a, const Sample& b) { return a.facet < b.facet; });
    std::uint32_t count = 0;
    for (std::size_t first = 0; first < samples.size();) {
        std::size_t last = first;
        double range = 0.0, height = 0.0;
        for (; last < samples.size() && samples[last].facet == samples[first].facet; ++last) {
            range += samples[last].range;
            height += samples[last].height;
        }
        const double n = double(last - first);
        row.sighting.push_back({.target = static_cast<std::uint32_t>(samples[first].facet),
                                .weight = static_cast<float>(n) * share,
                                .range = static_cast<float>(range / n),
                                .height = static_cast<float>(height / n)});
        ++count;
        first = last;
    }
    row.count.push_back(count);
}

/// Renames the facets seen to consecutive targets, ascending, and joins the rows.
void join(const std::vector<PixelRow>& rows, std::size_t facet_count, View& view) {
    std::vector<std::uint32_t> target(facet_count, 0);
    std::size_t sightings = 0;
    for (const PixelRow& row : rows) {
        for (const Sighting& s : row.sighting) target[s.target] = 1;
        sightings += row.sighting.size();
    }
    for (std::size_t f = 0; f < facet_count; ++f) {
        if (target[f] == 0) continue;
        target[f] = static_cast<std::uint32_t>(view.facet.size());
        view.facet.push_back(FacetId{static_cast<std::uint32_t>(f)});
    }
    view.sighting.reserve(sightings);
    view.row.reserve(view.pixels() + 1);
    view.row.push_back(0);
    for (const PixelRow& row : rows) {
        for (const std::uint32_t count : row.count) view.row.push_back(view.row.back() + count);
        for (Sighting s : row.sighting) {
            s.target = target[s.target];
            view.sighting.push_back(s);
        }
    }
}

}  // namespace

double level_height(const Eigen::Vector3d& place) {
    return place.z() + place.head<2>().squaredNorm() / (2e3 * earth_radius_km);
}

View cast_view(const RayScene& scene, const FacetSet& facets, const Observer& observer,
               const ViewOptions& options) {
    check_observer(observer);
    if (options.samples < 1 || options.samples > 4096) {
        throw InputError("observer " + observer.name, "samples a pixel must be 1 to 4096");
    }
    const auto width = static_cast<std::size_t>(observer.width);
    const auto height = static_cast<std::size_t>(observer.height);
    const auto samples = static_cast<std::size_t>(options.samples);
    const auto [columns, rows] = strata(options.samples);
    const PixelRays eye = pixel_rays(observer);
    const Eigen::Vector3f origin = observer.position.cast<float>();
    const float share = 1.0f / static_cast<float>(samples);

    View view;
    view.width = observer.width;
    view.height = observer.height;
    view.observer_height = level_height(observer.position);
    view.sky.assign(width * height, 0.0f);
    view.sky_zenith_deg.assign(width * height, 0.0f);
    view.centre.assign(width * height, no_facet);
    view.centre_range.assign(width * height, std::numeric_limits<float>::quiet_NaN());
    view.rays = width * height * (samples + 1);

    std::vector<PixelRow> picture(height);
    const auto cast_row = [&](std::size_t y) {
        PixelRow& out = picture[y];
        out.count.reserve(width);
        std::vector<Ray> rays(std::max(samples, width));
        std::vector<Hit> hits(rays.size());
        std::vector<Sample> seen(samples);
        for (Ray& ray : rays) ray.origin = origin;

        for (std::size_t x = 0; x < width; ++x) {
            rays[x].direction = eye.towards(double(x) + 0.5, double(y) + 0.5).cast<float>();
        }
        scene.closest(std::span(rays).first(width), std::span(hits).first(width));
        for (std::size_t x = 0; x < width; ++x) {
            if (hits[x].facet == no_facet) continue;
            view.centre[y * width + x] = hits[x].facet;
            view.centre_range[y * width + x] = hits[x].range;
        }

        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t pixel = y * width + x;
            for (std::size_t s = 0; s < samples; ++s) {
                const auto [right, down] = jitter(options.seed, pixel, s);
                const auto column = static_cast<int>(s) % columns;
                const auto row = static_cast<int>(s) / columns;
                rays[s].direction = eye.towards(double(x) + (column + right) / columns,
                                                double(y) + (row + down) / rows)
                                        .cast<float>();
            }
            // The samples of a pixel fill whole packets, which are the most alike rays there are.
            scene.closest(std::span(rays).first(samples), std::span(hits).first(samples));
            std::size_t solid = 0;
            double zenith = 0.0;
            for (std::size_t s = 0; s < samples; ++s) {
                if (hits[s].facet == no_facet) {
                    zenith +=
                        degrees(std::acos(std::clamp(double(rays[s].direction.z()), -1., 1.)));
                    continue;
                }
                const Eigen::Vector3d place =
                    observer.position + double(hits[s].range) * rays[s].direction.cast<double>();
                seen[solid++] = {hits[s].facet, hits[s].range,
                                 static_cast<float>(level_height(place))};
            }
            const std::size_t open = samples - solid;
            if (open > 0) {
                view.sky[pixel] = static_cast<float>(open) * share;
                view.sky_zenith_deg[pixel] = static_cast<float>(zenith / double(open));
            }
            gather(std::span(seen).first(solid), share, out);
        }
    };
    for_each_index(height, cast_row, 4);
    join(picture, facets.size(), view);
    return view;
}

}  // namespace diurna
