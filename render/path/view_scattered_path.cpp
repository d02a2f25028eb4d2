#include "render/path/view_scattered_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "render/path/direction_angles.hpp"
#include "render/path/scattered_path.hpp"
#include "render/view/pixel_rays.hpp"

namespace diurna {

namespace {

/// What a pixel's sightings have in common.
struct Seen {
    float weight = 0.0f, range = 0.0f, height = 0.0f;  // sums, then means
    float nearest = 1e30f, farthest = 0.0f;
};
Seen seen_in(const View& view, std::size_t pixel) {
    Seen seen;
    for (std::uint32_t k = view.row[pixel]; k < view.row[pixel + 1]; ++k) {
        const Sighting& s = view.sighting[k];
        const float range = view.range_of(s);
        seen.weight += s.weight;
        seen.range += s.weight * range;
        seen.height += s.weight * view.height_of(s);
        seen.nearest = std::min(seen.nearest, range);
        seen.farthest = std::max(seen.farthest, range);
    }
    if (seen.weight > 0.0f) {
        seen.range /= seen.weight;
        seen.height /= seen.weight;
    }
    return seen;
}

/// Unit vector to the sun, under the zenith angle that SunField has.
Eigen::Vector3d sun_direction(const RadianceInput& input) {
    const double zenith = radians(input.sun_zenith_deg), azimuth = azimuth_of(input.to_sun);
    return {std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth),
            std::cos(zenith)};
}

/// Where the middles of pixels look that see facets.
struct Directions {
    std::vector<float> angle_deg;  // (pixel) from the sun; negative: sees none
    std::vector<float> cosine;     // (pixel) of the zenith angle
};
Directions directions_of(const View& view, const Observer& observer, const RadianceInput& input) {
    const PixelRays rays = pixel_rays(observer);
    const Eigen::Vector3d sun = sun_direction(input);
    const auto width = static_cast<std::size_t>(view.width);
    Directions of{std::vector<float>(view.pixels(), -1.0f),
                  std::vector<float>(view.pixels(), 0.0f)};
    for_each_block(view.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (view.row[p] == view.row[p + 1]) continue;
            const Eigen::Vector3d to =
                rays.towards(double(p % width) + 0.5, double(p / width) + 0.5);
            of.angle_deg[p] = static_cast<float>(angle_between_deg(to, sun));
            of.cosine[p] = static_cast<float>(to.z());
        }
    });
    return of;
}

ScatteredPath::Angles extent_of(std::span<const float> angle_deg) {
    ScatteredPath::Angles angles{180.0, 0.0};
    for (const float a : angle_deg) {
        if (a < 0.0f) continue;
        angles.least_deg = std::min(angles.least_deg, double{a});
        angles.most_deg = std::max(angles.most_deg, double{a});
    }
    return angles;
}

}  // namespace

std::string add_scattered_paths(const View& view, const Observer& observer,
                                const RadianceInput& input, const BandLight& band,
                                std::span<float> plane) {
    if (view.sighting.empty()) return "no path";
    const Directions directions = directions_of(view, observer, input);
    const ScatteredPath table(*band.scattered, band.band, path_extent(view, input.ground_height_km),
                              extent_of(directions.angle_deg));
    const auto height_km = [&](float height) {
        return static_cast<float>(input.above_sea_km(double{height}));
    };
    for_each_block(view.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (directions.angle_deg[p] < 0.0f) continue;
            const auto direction =
                table.towards(double{directions.angle_deg[p]}, double{directions.cosine[p]});
            const Seen seen = seen_in(view, p);
            if (seen.farthest < 1.03f * seen.nearest) {
                plane[p] += seen.weight * table(direction, seen.range, height_km(seen.height));
                continue;
            }
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                plane[p] +=
                    s.weight * table(direction, view.range_of(s), height_km(view.height_of(s)));
            }
        }
    });
    return fmt::format("interpolation error {:.2g} % with {} ranges, {} heights, {} angles",
                       100.0 * table.error(), table.ranges(), table.heights(), table.angles());
}

}  // namespace diurna
