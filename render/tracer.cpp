#include "render/tracer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "materials/error.hpp"
#include "render/band_table.hpp"
#include "render/leaving.hpp"
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
    for (const Sighting& s : view.sighting) {
        near = std::min(near, s.range);
        far = std::max(far, s.range);
        low = std::min(low, s.height);
        high = std::max(high, s.height);
    }
    extent.least_range_km = 1e-3 * double(near);
    extent.most_range_km = 1e-3 * double(far);
    extent.least_height_km = ground_height_km + 1e-3 * double(low);
    extent.most_height_km = ground_height_km + 1e-3 * double(high);
    return extent;
}

/// The range nodes each target needs, so that its radiance at the eye is formed there only.
struct Reach {
    std::vector<std::uint32_t> first;   // (target) first range node
    std::vector<std::uint32_t> offset;  // (target + 1) into (target, its range nodes)
};

Reach reach_of(const View& view, const PathTable& path) {
    std::vector<float> near(view.facet.size(), std::numeric_limits<float>::max());
    std::vector<float> far(view.facet.size(), 0.0f);
    for (const Sighting& s : view.sighting) {
        near[s.target] = std::min(near[s.target], s.range);
        far[s.target] = std::max(far[s.target], s.range);
    }
    Reach reach;
    reach.first.resize(near.size());
    reach.offset.assign(near.size() + 1, 0);
    for (std::size_t k = 0; k < near.size(); ++k) {
        const std::size_t first = path.range_stencil(near[k]).start;
        const std::size_t last = path.range_stencil(far[k]).start + 3;
        reach.first[k] = static_cast<std::uint32_t>(first);
        reach.offset[k + 1] = reach.offset[k] + static_cast<std::uint32_t>(last - first + 1);
    }
    return reach;
}

float dot(const float* a, const float* b, std::size_t n) {
    float sum = 0.0f;
#pragma omp simd reduction(+ : sum)
    for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
    return sum;
}

/// Radiance at the eye of every target at its grid nodes, (target, range node, height, column).
struct AtEye {
    std::size_t columns = 0;
    std::vector<float> value;
};

/// Carries leaving radiance (target, channel) through the air into one column.
void carry(const std::vector<float>& leaving, std::size_t padded, const PathTable& path,
           std::size_t band, const Reach& reach, std::size_t column, AtEye& eye) {
    const std::size_t heights = path.heights();
    for_each_index(reach.first.size(), [&](std::size_t k) {
        const float* from = &leaving[k * padded];
        for (std::uint32_t slot = reach.offset[k]; slot < reach.offset[k + 1]; ++slot) {
            const std::size_t range = reach.first[k] + (slot - reach.offset[k]);
            for (std::size_t h = 0; h < heights; ++h) {
                eye.value[(slot * heights + h) * eye.columns + column] +=
                    dot(path.transmittance(band, range, h), from, padded);
            }
        }
    });
}

void add_path(const PathTable& path, std::size_t band, const Reach& reach, std::size_t column,
              AtEye& eye) {
    const std::size_t heights = path.heights();
    for_each_index(reach.first.size(), [&](std::size_t k) {
        for (std::uint32_t slot = reach.offset[k]; slot < reach.offset[k + 1]; ++slot) {
            const std::size_t range = reach.first[k] + (slot - reach.offset[k]);
            for (std::size_t h = 0; h < heights; ++h) {
                eye.value[(slot * heights + h) * eye.columns + column] +=
                    path.radiance(band, range, h);
            }
        }
    });
}

/// Per band: the background over the zenith angles at which some pixel sees it.
std::vector<BackgroundTable> backgrounds(const View& view, std::span<const Band> bands,
                                         const RadianceInput& input) {
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
    for (const Band& band : bands) tables.emplace_back(input, band, eye_km, least, most);
    return tables;
}

/// Sums sightings and background into planes (column)(pixel).
std::vector<std::vector<float>> sum_pixels(const View& view, const AtEye& eye,
                                           const PathTable& path, const Reach& reach,
                                           std::span<const BackgroundTable> background,
                                           std::size_t columns_per_band, double ground_height_km) {
    constexpr std::size_t most_columns = 64;
    const std::size_t columns = eye.columns, heights = path.heights();
    if (columns > most_columns) throw InputError("render", "too many bands and terms at once");
    std::vector<std::vector<float>> planes(columns, std::vector<float>(view.pixels()));
    for_each_block(view.pixels(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            std::array<float, most_columns> sum{};
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                const Stencil across = path.range_stencil(s.range);
                const auto up =
                    path.height_weights(static_cast<float>(ground_height_km + 1e-3 * s.height));
                const std::size_t slot =
                    reach.offset[s.target] + (across.start - reach.first[s.target]);
                const float* value = &eye.value[slot * heights * columns];
                for (std::size_t r = 0; r < 4; ++r) {
                    for (std::size_t h = 0; h < heights; ++h) {
                        const float weight = s.weight * across.weight[r] * up[h];
                        for (std::size_t c = 0; c < columns; ++c) sum[c] += weight * value[c];
                        value += columns;
                    }
                }
            }
            if (view.sky[p] > 0.0f) {
                for (std::size_t b = 0; b < background.size(); ++b) {
                    // The background is air, or ends in air: it counts as path.
                    sum[(b + 1) * columns_per_band - 1] +=
                        view.sky[p] * static_cast<float>(background[b](view.sky_zenith_deg[p]));
                }
            }
            for (std::size_t c = 0; c < columns; ++c) planes[c][p] = sum[c];
        }
    });
    return planes;
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
        [&](std::size_t p) { temperature[p] = static_cast<float>(scale(double(radiance[p]))); },
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
    for (double& value : radiance) value *= 0.1 / std::numbers::pi;
    return radiance;
}

/// Light at three heights, per band.
std::vector<std::array<Light, 3>> light_of(const RadianceInput& input, const LitFacets& lit,
                                           std::span<const Band> bands) {
    std::vector<std::array<Light, 3>> light(bands.size());
    for_each_index(
        bands.size() * 3,
        [&](std::size_t k) {
            light[k / 3][k % 3] = light_at(input, lit.height_km[k % 3], bands[k / 3].node_um);
        },
        1);
    return light;
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

    const LitFacets lit = lit_facets(input, view.facet);
    const TemperatureGrid grid = temperature_grid(lit.coldest, lit.hottest);
    const auto light = light_of(input, lit, bands);

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
        tables.back().black(lit.coldest, cold.data());
        tables.back().black(lit.hottest, hot.data());
        std::transform(cold.begin(), cold.end(), mirror.begin(), [](float x) { return 0.2f * x; });
        probes.push_back({std::move(cold), std::move(hot), std::move(mirror)});
    }

    const PathTable path(input.atmosphere, extent_of(view, input.ground_height_km), bands, channels,
                         probes, options.tolerance);
    const Reach reach = reach_of(view, path);
    const std::size_t per_band = options.terms ? term_count : 1;
    AtEye eye{.columns = bands.size() * per_band, .value = {}};
    eye.value.assign(std::size_t{reach.offset.back()} * path.heights() * eye.columns, 0.0f);

    std::vector<float> leaving_here;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const ReflectedLight reflected =
            reflected_light(bands[b], channels[b], input.materials, lit.material_used, light[b]);
        const Leaving leaving(input, lit, tables[b], reflected);
        const std::size_t padded = channels[b].padded();
        if (options.terms) {
            for (std::size_t t = 0; t + 1 < term_count; ++t) {
                leaving.term(static_cast<Term>(t), view.facet, leaving_here);
                carry(leaving_here, padded, path, b, reach, b * per_band + t, eye);
            }
        } else {
            leaving.total(view.facet, leaving_here);
            carry(leaving_here, padded, path, b, reach, b, eye);
        }
        add_path(path, b, reach, (b + 1) * per_band - 1, eye);
    }

    const auto background = backgrounds(view, bands, input);
    auto planes = sum_pixels(view, eye, path, reach, background, per_band, input.ground_height_km);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const Band& band = bands[b];
        std::vector<float> radiance(view.pixels());
        for (std::size_t p = 0; p < radiance.size(); ++p) {
            double sum = 0.0;
            for (std::size_t c = 0; c < per_band; ++c) sum += double(planes[b * per_band + c][p]);
            radiance[p] = static_cast<float>(sum);
        }
        auto temperature = apparent_temperature(band, radiance);
        frame.planes.push_back({"radiance." + band.name, "W m-2 sr-1", std::move(radiance)});
        frame.planes.push_back({"apparent_temperature." + band.name, "K", std::move(temperature)});
        for (std::size_t t = 0; options.terms && t < term_count; ++t) {
            frame.planes.push_back({fmt::format("{}.{}", term_names[t], band.name), "W m-2 sr-1",
                                    std::move(planes[b * per_band + t])});
        }
        frame.notes["band." + band.name] =
            fmt::format("{:g} to {:g} um", band.from_um(), band.to_um());
        frame.notes["error." + band.name] =
            fmt::format("{:.2g} mK from {} ranges, {} heights", 1e3 * path.error(b), path.ranges(),
                        path.heights());
    }
    if (options.truth) add_truth(view, input, frame);
    return frame;
}

}  // namespace diurna
