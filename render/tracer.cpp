#include "render/tracer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "materials/error.hpp"
#include "materials/planck.hpp"
#include "materials/units.hpp"
#include "render/band_table.hpp"
#include "render/leaving.hpp"
#include "render/mode_table.hpp"
#include "render/path_table.hpp"
#include "terrain/parallel.hpp"

namespace diurna {

namespace {

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
    expect("sky_view", input.sky_view.sky_view.size());
    if (input.sky_view.exchange.row.size() != n + 1) {
        throw InputError("render", "the exchange rows do not fit the facets");
    }
    if (!view.facet.empty() && index(view.facet.back()) >= n) {
        throw InputError("render", "the view was cast on other facets");
    }
}

PathExtent extent_of(const View& view, double ground_height_km) {
    PathExtent extent;
    extent.observer_height_km = ground_height_km + 1e-3 * view.observer_height;
    if (view.sighting.empty()) return extent;
    float near = 1e30f, far = 0.0f, low = 1e30f, high = -1e30f;
    for (std::size_t t = 0; t < view.facet.size(); ++t) {
        near = std::min(near, view.range[t]);
        far = std::max(far, view.range[t]);
        low = std::min(low, view.target_height[t]);
        high = std::max(high, view.target_height[t]);
    }
    extent.least_range_km = 1e-3 * double(near);
    extent.most_range_km = 1e-3 * double(far);
    extent.least_height_km = ground_height_km + 1e-3 * double(low);
    extent.most_height_km = ground_height_km + 1e-3 * double(high);
    return extent;
}

/// A band's PathTable in modes, nodes side by side: (range, height, mode).
struct EyeTable {
    std::size_t padded, heights;
    std::vector<float> transmittance;
    std::vector<float> radiance;  // (range, height)

    EyeTable(const PathTable& path, std::size_t band, const ModeBasis& basis)
        : padded(basis.padded()), heights(path.heights()) {
        const std::size_t nodes = path.ranges() * heights;
        transmittance.resize(nodes * padded);
        radiance.resize(nodes);
        for (std::size_t k = 0; k < nodes; ++k) {
            basis.project(path.transmittance(band, k / heights, k % heights),
                          &transmittance[k * padded]);
            radiance[k] = path.radiance(band, k / heights, k % heights);
        }
    }
};

/// Radiance at the eye of a target, and how it changes with range [1/m] and height [1/m].
struct AtEye {
    float value, by_range, by_height;
};

/// Where a target lies on the grid, with slopes by range [1/m] and height [1/m].
struct GridPlace {
    std::size_t start;
    std::array<float, 4> range, range_slope;
    std::array<float, 5> height, height_slope;

    GridPlace(const PathTable& path, float range_m, float height_m, double ground_height_km) {
        const double root = double{std::cbrt(1e-3f * range_m)};
        const double x = path.place(root);
        const Stencil s = stencil(x, path.ranges());
        start = s.start;
        range = s.weight;
        range_slope = stencil_slopes(x, s);
        const auto scale =
            static_cast<float>(path.places_per_root() * root / (3.0 * double{range_m}));
        for (float& w : range_slope) w *= scale;
        path.height_weights(static_cast<float>(ground_height_km + 1e-3 * double{height_m}), height,
                            height_slope);
        for (float& w : height_slope) w *= 1e-3f;
    }
};

/// Transmittance (mode) to a place with its slopes, and radiance of the air.
struct Air {
    std::array<std::vector<float>, 3> transmittance;  // value, by range, by height
    AtEye path{};

    explicit Air(std::size_t padded) {
        for (auto& t : transmittance) t.resize(padded);
    }
    void at(const EyeTable& table, const GridPlace& place) {
        const std::size_t n = table.padded, heights = table.heights;
        float* value = transmittance[0].data();
        float* by_range = transmittance[1].data();
        float* by_height = transmittance[2].data();
        std::fill_n(value, n, 0.0f);
        std::fill_n(by_range, n, 0.0f);
        std::fill_n(by_height, n, 0.0f);
        path = {};
        for (std::size_t h = 0; h < heights; ++h) {
            const std::size_t node = place.start * heights + h, step = heights;
            const float* t = &table.transmittance[node * n];
            const float* p = &table.radiance[node];
            const float w0 = place.range[0], w1 = place.range[1], w2 = place.range[2],
                        w3 = place.range[3];
            const float s0 = place.range_slope[0], s1 = place.range_slope[1],
                        s2 = place.range_slope[2], s3 = place.range_slope[3];
            const float up = place.height[h], up_slope = place.height_slope[h];
            const std::size_t stride = step * n;
#pragma omp simd
            for (std::size_t k = 0; k < n; ++k) {
                const float t0 = t[k], t1 = t[k + stride], t2 = t[k + 2 * stride],
                            t3 = t[k + 3 * stride];
                const float across = w0 * t0 + w1 * t1 + w2 * t2 + w3 * t3;
                value[k] += up * across;
                by_range[k] += up * (s0 * t0 + s1 * t1 + s2 * t2 + s3 * t3);
                by_height[k] += up_slope * across;
            }
            const float across = w0 * p[0] + w1 * p[step] + w2 * p[2 * step] + w3 * p[3 * step];
            path.value += up * across;
            path.by_range += up * (s0 * p[0] + s1 * p[step] + s2 * p[2 * step] + s3 * p[3 * step]);
            path.by_height += up_slope * across;
        }
    }
    /// A spectrum that leaves the place, as it arrives.
    AtEye carried(const float* leaving) const {
        const std::size_t n = transmittance[0].size();
        return {dot(transmittance[0].data(), leaving, n), dot(transmittance[1].data(), leaving, n),
                dot(transmittance[2].data(), leaving, n)};
    }

 private:
    static float dot(const float* a, const float* b, std::size_t n) {
        float sum = 0.0f;
#pragma omp simd reduction(+ : sum)
        for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
        return sum;
    }
};

/// The same for one spectrum without keeping the transmittance: radiance at the eye of all that
/// leaves a place and of the air before it. Eight modes at a time stay in registers.
AtEye carry(const EyeTable& table, const GridPlace& place, const float* leaving) {
    using Lane = Eigen::Array<float, 8, 1>;
    const auto load = [](const float* from) { return Eigen::Map<const Lane>(from); };
    const std::size_t n = table.padded, heights = table.heights, stride = heights * n;
    const auto &w = place.range, &s = place.range_slope;
    Lane value = Lane::Zero(), by_range = Lane::Zero(), by_height = Lane::Zero();
    const float* first = &table.transmittance[place.start * stride];
    for (std::size_t k = 0; k < n; k += 8) {
        Lane here = Lane::Zero(), deeper = Lane::Zero(), higher = Lane::Zero();
        for (std::size_t h = 0; h < heights; ++h) {
            const float* t = first + h * n + k;
            const Lane t0 = load(t), t1 = load(t + stride), t2 = load(t + 2 * stride),
                       t3 = load(t + 3 * stride);
            const Lane across = w[0] * t0 + w[1] * t1 + w[2] * t2 + w[3] * t3;
            here += place.height[h] * across;
            higher += place.height_slope[h] * across;
            deeper += place.height[h] * (s[0] * t0 + s[1] * t1 + s[2] * t2 + s[3] * t3);
        }
        const Lane from = load(leaving + k);
        value += from * here;
        by_range += from * deeper;
        by_height += from * higher;
    }
    AtEye eye{value.sum(), by_range.sum(), by_height.sum()};
    for (std::size_t h = 0; h < heights; ++h) {
        const float* p = &table.radiance[place.start * heights + h];
        const float p0 = p[0], p1 = p[heights], p2 = p[2 * heights], p3 = p[3 * heights];
        const float across = w[0] * p0 + w[1] * p1 + w[2] * p2 + w[3] * p3;
        eye.value += place.height[h] * across;
        eye.by_height += place.height_slope[h] * across;
        eye.by_range += place.height[h] * (s[0] * p0 + s[1] * p1 + s[2] * p2 + s[3] * p3);
    }
    return eye;
}

/// Azimuths of a picture's sky from the sun [deg], without a jump but opposite to the optical axis.
struct PixelAzimuths {
    PixelRays rays;
    double axis_deg, from_sun_deg;
    double least = 0.0, most = 0.0;

    PixelAzimuths(const View& view, const Observer& observer, const RadianceInput& input)
        : rays(pixel_rays(observer)),
          axis_deg(observer.azimuth_deg),
          from_sun_deg(std::remainder(
              observer.azimuth_deg - degrees(std::atan2(input.to_sun.x(), input.to_sun.y())),
              360.0)) {
        bool first = true;
        for (std::size_t p = 0; p < view.pixels(); ++p) {
            if (!(view.sky[p] > 0.0f)) continue;
            const double here = (*this)(view, p);
            least = first ? here : std::min(least, here);
            most = first ? here : std::max(most, here);
            first = false;
        }
    }
    /// Of a pixel's middle.
    double operator()(const View& view, std::size_t pixel) const {
        const auto width = static_cast<std::size_t>(view.width);
        const Eigen::Vector3d to =
            rays.towards(double(pixel % width) + 0.5, double(pixel / width) + 0.5);
        return from_sun_deg + std::remainder(degrees(std::atan2(to.x(), to.y())) - axis_deg, 360.0);
    }
};

/// Per band: the background over the zenith angles at which some pixel sees it.
std::vector<BackgroundTable> backgrounds(const View& view, std::span<const Band> bands,
                                         const RadianceInput& input,
                                         const std::optional<PixelAzimuths>& azimuths,
                                         std::span<const std::optional<SunField>> scattered) {
    float least = 180.0f, most = 0.0f;
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        if (view.sky[p] > 0.0f) {
            least = std::min(least, view.sky_zenith_deg[p]);
            most = std::max(most, view.sky_zenith_deg[p]);
        }
    }
    std::vector<BackgroundTable> tables;
    if (least > most) return tables;
    const double eye_km = input.ground_height_km + 1e-3 * view.observer_height;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        tables.emplace_back(input, bands[b], eye_km, least, most);
        if (scattered[b]) {
            tables.back().add_sunlight(input, bands[b], *scattered[b], eye_km, azimuths->least,
                                       azimuths->most);
        }
    }
    return tables;
}

/// Sums sightings of one band's targets into planes (column)(pixel); the last column is the air's,
/// or the only one.
template <std::size_t Columns>
void sum_pixels(const View& view, const std::vector<AtEye>& eye, const BackgroundTable* background,
                const PixelAzimuths* azimuths, std::span<std::vector<float>> planes) {
    for_each_block(view.pixels(), 2048, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            std::array<float, Columns> sum{};
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                const AtEye* at = &eye[s.target * Columns];
                for (std::size_t c = 0; c < Columns; ++c) {
                    sum[c] += s.weight * (at[c].value + s.deeper * at[c].by_range +
                                          s.higher * at[c].by_height);
                }
            }
            if (view.sky[p] > 0.0f) {
                // The background is air, or ends in air: it counts as path.
                const double azimuth = azimuths != nullptr ? (*azimuths)(view, p) : 0.0;
                sum[Columns - 1] += view.sky[p] * static_cast<float>((*background)(
                                                      view.sky_zenith_deg[p], azimuth));
            }
            for (std::size_t c = 0; c < Columns; ++c) planes[c][p] = sum[c];
        }
    });
}

std::vector<float> apparent_temperature(const Band& band, const std::vector<float>& radiance) {
    float least = std::numeric_limits<float>::max(), most = 0.0f;
    for (const float value : radiance) {
        if (value > 0.0f) least = std::min(least, value);
        most = std::max(most, value);
    }
    const TemperatureScale scale(band, std::min(least, most), most);
    std::vector<float> temperature(radiance.size());
    for_each_index(
        radiance.size(),
        [&](std::size_t p) { temperature[p] = static_cast<float>(scale(double{radiance[p]})); },
        4096);
    return temperature;
}

void add_truth(const View& view, const RadianceInput& input, Frame& frame) {
    constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
    const FacetSet& facets = input.facets;
    const auto add = [&](const char* name, const char* unit, float sky, const auto& value) {
        Plane plane{name, unit, std::vector<float>(view.pixels(), sky)};
        for_each_index(
            view.pixels(),
            [&](std::size_t p) {
                if (view.centre[p] != no_facet) {
                    plane.pixel[p] = static_cast<float>(value(index(view.centre[p])));
                }
            },
            8192);
        frame.planes.push_back(std::move(plane));
    };
    add("temperature", "K", nothing, [&](std::size_t f) { return input.temperature[f]; });
    frame.planes.push_back({"range", "m", view.centre_range});
    add("facet", "1", -1.0f, [&](std::size_t f) { return f; });
    add("object", "1", -1.0f,
        [&](std::size_t f) { return static_cast<unsigned>(facets.object[f]); });
    add("material", "1", -1.0f, [&](std::size_t f) { return index(facets.material[f]); });
    add("normal.X", "1", nothing, [&](std::size_t f) { return facets.normal[f].x(); });
    add("normal.Y", "1", nothing, [&](std::size_t f) { return facets.normal[f].y(); });
    add("normal.Z", "1", nothing, [&](std::size_t f) { return facets.normal[f].z(); });
}

/// Radiance of sunlit surroundings of middling albedo, per node: the weight by which reflectances
/// are averaged in a channel, where a factor of two does not matter. Empty at night.
std::vector<double> scattered_sunlight(const RadianceInput& input, const Light& light) {
    if (input.sun_fraction.empty() || input.sun_zenith_deg >= 90.0) return {};
    std::vector<double> radiance = light.sun;
    for (std::size_t n = 0; n < radiance.size(); ++n) {
        radiance[n] = 0.1 * (radiance[n] / std::numbers::pi + light.sky[n]);
    }
    return radiance;
}

/// Light at three heights, per band.
std::vector<std::array<Light, 3>> light_of(const RadianceInput& input, const LitFacets& lit,
                                           std::span<const Band> bands,
                                           std::span<const std::optional<SunField>> scattered) {
    std::vector<std::array<Light, 3>> light(bands.size());
    for_each_index(
        bands.size() * 3,
        [&](std::size_t k) {
            const auto& field = scattered[k / 3];
            light[k / 3][k % 3] = light_at(input, lit.height_km[k % 3], bands[k / 3].node_um,
                                           field ? &*field : nullptr);
        },
        1);
    return light;
}

float middle(const TemperatureExtent& extent) { return 0.5f * (extent.coldest + extent.hottest); }

/// The greatest reflectance of each material in a band.
std::vector<float> greatest_reflectance(const Band& band, const MaterialLibrary& materials,
                                        const std::vector<bool>& used) {
    std::vector<float> greatest(materials.size(), 0.0f);
    for (std::size_t m = 0; m < greatest.size(); ++m) {
        if (!used[m]) continue;
        const Material& material = materials[MaterialId{static_cast<std::uint16_t>(m)}];
        for (const double um : band.node_um) {
            greatest[m] = std::max(greatest[m], static_cast<float>(material.reflectance.at(um)));
        }
    }
    return greatest;
}

/// Modes for all that surfaces send out in a band, good to 0.4 mK at the cold end of the scene or
/// 1e-9 of the sunlight it reflects.
ModeBasis basis_of(const Band& band, const Channels& channels, const SurfaceTable& table,
                   const ReflectedLight& light, const RadianceInput& input, const LitFacets& lit,
                   const TemperatureExtent& extent) {
    constexpr std::size_t steps = 10;
    const std::size_t n = channels.padded();
    std::vector<std::vector<float>> generators;
    const auto add = [&](const auto& value) {
        std::vector<float>& g = generators.emplace_back(n);
        for (std::size_t c = 0; c < channels.size(); ++c) g[c] = value(c);
    };
    std::vector<float> black(n), emitted(n), reflectance(n), other(n);
    table.black(middle(extent), black.data());
    add([&](std::size_t c) { return black[c]; });
    double sunlit = 0.0;
    for (std::size_t s = 0; s <= steps; ++s) {
        const float temperature = extent.coldest + (extent.hottest - extent.coldest) *
                                                       static_cast<float>(s) / float(steps);
        table.black(temperature, black.data());
        add([&](std::size_t c) { return black[c]; });
        for (std::size_t m = 0; m < input.materials.size(); ++m) {
            if (!lit.material_used[m]) continue;
            table.surface(MaterialId{static_cast<std::uint16_t>(m)}, temperature, emitted.data(),
                          reflectance.data());
            add([&](std::size_t c) { return emitted[c]; });
            if (s % (steps / 2) == 0) add([&](std::size_t c) { return reflectance[c] * black[c]; });
        }
    }
    table.black(middle(extent), black.data());
    for (std::size_t m = 0; m < input.materials.size(); ++m) {
        if (!lit.material_used[m]) continue;
        const MaterialId id{static_cast<std::uint16_t>(m)};
        for (std::size_t h = 0; h < 3; ++h) {
            add([&](std::size_t c) { return light.sun[m][h][c] / std::numbers::pi_v<float>; });
            double norm = 0.0;
            for (const float x : generators.back()) norm += double{x} * double{x};
            sunlit = std::max(sunlit, std::sqrt(norm));
            add([&](std::size_t c) { return light.sky[m][h][c]; });
        }
        if (const float* room = table.room(id)) add([&](std::size_t c) { return room[c]; });
        // Light reflected twice.
        table.surface(id, middle(extent), emitted.data(), reflectance.data());
        for (std::size_t k = 0; k < input.materials.size(); ++k) {
            if (!lit.material_used[k]) continue;
            table.surface(MaterialId{static_cast<std::uint16_t>(k)}, middle(extent), emitted.data(),
                          other.data());
            add([&](std::size_t c) { return other[c] * reflectance[c] * black[c]; });
            add([&](std::size_t c) {
                return other[c] * light.sun[m][1][c] / std::numbers::pi_v<float>;
            });
            add([&](std::size_t c) { return other[c] * light.sky[m][1][c]; });
        }
    }
    const double tolerance =
        std::max(4e-4 * band_radiance_derivative(band, double{extent.coldest}), 1e-9 * sunlit);
    return ModeBasis(generators, channels.size(), tolerance);
}

/// Bounces, with the worth of sunlight and of the scene's spread in kelvins at its cold end.
BounceOptions bounce_options(const Band& band, const TemperatureExtent& extent, const Light& light,
                             bool scattered, const FrameOptions& options) {
    const double slope = band_radiance_derivative(band, double{extent.coldest});
    const double sunlight = band_sum_nodes(band, light.sun) / std::numbers::pi / slope;
    // Planck's law is convex in temperature: the hot end counts more than its kelvins.
    const double warmth = (band_radiance(band, double{extent.hottest}) -
                           band_radiance(band, double{extent.coldest})) /
                          slope;
    const double kelvins = std::max(1e-3, double{extent.hottest} - double{extent.coldest});
    const double steepness = std::max(1.0, warmth / kelvins);
    BounceOptions bounce{.bounces = options.bounces};
    bounce.tolerance = static_cast<float>(0.3 * options.tolerance / steepness);
    bounce.sunlight = static_cast<float>(std::min(1e30, sunlight / steepness));
    if (scattered) {
        bounce.skylight =
            static_cast<float>(std::min(1e30, band_sum_nodes(band, light.sky) / slope / steepness));
    }
    bounce.most_change = static_cast<float>(kelvins) + bounce.sunlight + bounce.skylight;
    return bounce;
}

std::vector<float> sum_of(const std::vector<std::vector<float>>& planes) {
    std::vector<float> sum(planes[0].size());
    for (std::size_t p = 0; p < sum.size(); ++p) {
        double total = 0.0;
        for (const auto& plane : planes) total += double{plane[p]};
        sum[p] = static_cast<float>(total);
    }
    return sum;
}

}  // namespace

Frame render(const View& view, const Observer& observer, std::span<const Band> bands,
             const RadianceInput& input, const FrameOptions& options) {
    check_sizes(view, input);
    Frame frame;
    frame.width = view.width;
    frame.height = view.height;
    frame.instant = input.instant;
    frame.observer = observer.name;

    if (bands.empty()) {
        if (options.truth) add_truth(view, input, frame);
        return frame;
    }
    std::optional<LitFacets> own;
    if (!options.lit) own = lit_facets(input, view.facet);
    const LitFacets& lit = options.lit ? *options.lit : *own;
    const TemperatureExtent extent = temperature_extent(input, lit);
    const TemperatureGrid grid = temperature_grid(extent.coldest, extent.hottest);
    std::vector<std::optional<SunField>> scattered(bands.size());
    for_each_index(
        bands.size(), [&](std::size_t b) { scattered[b] = scattered_sun(input, bands[b].node_um); },
        1);
    const auto light = light_of(input, lit, bands, scattered);
    std::vector<Channels> channels;
    std::vector<SurfaceTable> tables;
    std::vector<std::vector<std::vector<float>>> probes;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const Band& band = bands[b];
        channels.push_back(channels_of(band));
        tables.emplace_back(band, channels.back(), input.materials, lit.material_used, grid,
                            scattered_sunlight(input, light[b][1]));
        // Black bodies as cold and as hot as the scene, and a mirror of a cold sky.
        std::vector<float> cold(channels.back().padded()), hot(cold.size()), mirror(cold.size());
        tables.back().black(extent.coldest, cold.data());
        tables.back().black(extent.hottest, hot.data());
        std::transform(cold.begin(), cold.end(), mirror.begin(), [](float x) { return 0.2f * x; });
        probes.push_back({std::move(cold), std::move(hot), std::move(mirror)});
        // Where sunlight outshines heat, an error is worth more kelvins.
        if (const auto sunlit = scattered_sunlight(input, light[b][1]); !sunlit.empty()) {
            const std::vector<double> one(sunlit.size(), 1.0);
            probes.back().push_back(channel_sums(band, channels[b], one, sunlit));
            for (std::size_t c = 0; c < channels[b].padded(); ++c) {
                probes.back().back()[c] += probes.back().front()[c];
            }
        }
    }
    const PathTable path(input.atmosphere, extent_of(view, input.ground_height_km), bands, channels,
                         probes, options.tolerance);
    std::optional<PixelAzimuths> azimuths;
    if (std::any_of(scattered.begin(), scattered.end(),
                    [](const auto& s) { return s.has_value(); })) {
        azimuths.emplace(view, observer, input);
    }
    const auto background = backgrounds(view, bands, input, azimuths, scattered);
    const std::size_t per_band = options.terms ? term_count : 1;
    std::vector<AtEye> eye(view.facet.size() * per_band);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const Band& band = bands[b];
        const ReflectedLight in_channels =
            reflected_light(band, channels[b], input.materials, lit.material_used, light[b]);
        const ModeBasis basis =
            basis_of(band, channels[b], tables[b], in_channels, input, lit, extent);
        const ModeTable surface(tables[b], basis, input.materials.size(), lit.material_used,
                                middle(extent));
        const ReflectedLight reflected = in_modes(in_channels, basis);
        const Leaving leaving(
            input, lit, surface, reflected,
            greatest_reflectance(band, input.materials, lit.material_used),
            bounce_options(band, extent, light[b][2], scattered[b].has_value(), options));
        const EyeTable air_table(path, b, basis);
        for_each_block(view.facet.size(), 1024, [&](std::size_t begin, std::size_t end) {
            Air air(basis.padded());
            std::vector<float> spectrum(basis.padded() * term_count);
            for (std::size_t t = begin; t < end; ++t) {
                const GridPlace place(path, view.range[t], view.target_height[t],
                                      input.ground_height_km);
                if (options.terms) {
                    air.at(air_table, place);
                    leaving.terms(view.facet[t], spectrum.data());
                    for (std::size_t c = 0; c + 1 < term_count; ++c) {
                        eye[t * per_band + c] = air.carried(&spectrum[c * basis.padded()]);
                    }
                    eye[t * per_band + term_count - 1] = air.path;
                } else {
                    leaving.total(view.facet[t], spectrum.data());
                    eye[t] = carry(air_table, place, spectrum.data());
                }
            }
        });
        std::vector<std::vector<float>> planes(per_band, std::vector<float>(view.pixels()));
        const BackgroundTable* sky = background.empty() ? nullptr : &background[b];
        if (options.terms) {
            sum_pixels<term_count>(view, eye, sky, azimuths ? &*azimuths : nullptr, planes);
        } else {
            sum_pixels<1>(view, eye, sky, azimuths ? &*azimuths : nullptr, planes);
        }
        std::vector<float> radiance = options.terms ? sum_of(planes) : std::move(planes[0]);
        auto temperature = apparent_temperature(band, radiance);
        frame.planes.push_back({"radiance." + band.name, "W m-2 sr-1", std::move(radiance)});
        frame.planes.push_back({"apparent_temperature." + band.name, "K", std::move(temperature)});
        for (std::size_t t = 0; options.terms && t < term_count; ++t) {
            frame.planes.push_back({fmt::format("{}.{}", term_names[t], band.name), "W m-2 sr-1",
                                    std::move(planes[t])});
        }
        frame.notes["band." + band.name] =
            fmt::format("{:g} to {:g} um", band.from_um(), band.to_um());
        frame.notes["error." + band.name] = fmt::format(
            "{:.2g} mK from {} ranges, {} heights, {} modes of {} channels", 1e3 * path.error(b),
            path.ranges(), path.heights(), basis.size(), channels[b].size());
    }
    if (options.truth) add_truth(view, input, frame);
    return frame;
}

}  // namespace diurna
