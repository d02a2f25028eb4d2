#include "render/tracer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/radiation/planck.hpp"
#include "render/eye/eye_table.hpp"
#include "render/eye/pixel_sum.hpp"
#include "render/eye/truth.hpp"
#include "render/light/band_channels.hpp"
#include "render/light/interreflection.hpp"
#include "render/light/scene_basis.hpp"
#include "render/path/background.hpp"
#include "render/path/path_table.hpp"
#include "render/path/scattered_path.hpp"
#include "render/rays/shading.hpp"

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
    expect("sky_view", input.views.sky.size());
    if (input.views.others.row.size() != n + 1) {
        throw InputError("render", "the exchange rows do not fit the facets");
    }
    if (view.facets > n) {
        throw InputError("render", "the view was cast on other facets");
    }
}

PathExtent extent_of(const View& view, double ground_height_km) {
    PathExtent extent;
    extent.observer_height_km = ground_height_km + 1e-3 * view.observer_height;
    if (view.sighting.empty()) return extent;
    extent.least_range_km = 1e-3 * double{view.extent.near};
    extent.most_range_km = 1e-3 * double{view.extent.far};
    extent.least_height_km = ground_height_km + 1e-3 * double{view.extent.low};
    extent.most_height_km = ground_height_km + 1e-3 * double{view.extent.high};
    return extent;
}

/// All that is worked out per band before any facet is looked at.
struct BandState {
    std::optional<SunField> scattered;
    std::array<Light, 3> light;  // at the heights of LitFacets
    std::vector<NodeOptics> optics;
    Channels channels;
    std::vector<std::vector<float>> probes;  // (probe)(channel)
    SpectralBasis basis;
};

std::vector<BandState> prepare(std::span<const Band> bands, const RadianceInput& input,
                               const LitFacets& lit, const TemperatureExtent& extent) {
    std::vector<BandState> states(bands.size());
    for_each_index(
        bands.size(),
        [&](std::size_t b) {
            const Band& band = bands[b];
            BandState& state = states[b];
            state.scattered = scattered_sun(input, band.node_um);
            const SunField* field = state.scattered ? &*state.scattered : nullptr;
            for_each_index(
                3,
                [&](std::size_t h) {
                    state.light[h] = light_at(input, lit.height_km[h], band.node_um, field);
                },
                1);
            state.optics = node_optics(band, input.materials, lit.material_used);
            state.channels = channels_of(band);
            state.probes = probes(band, state.channels, input, state.light[1], extent);
            state.basis = scene_basis(band, state.optics, state.light, lit.worth[b], extent);
        },
        1);
    return states;
}

/// Radiance at the eye of every target, (target, column); the tables of a band follow each other.
void look(const View& view, const LitFacets& lit, const LitState& state, const LightTables& tables,
          const SentLight& sent, std::span<const EyeRow> rows, const EyeGrid& grid,
          std::span<const EyeTable> eye_tables, AtEye* eye) {
    constexpr std::size_t ahead = 12;
    const std::size_t columns = eye_tables.size(), per_band = columns / rows.size();
    for_each_block(view.facet.size(), 2048, [&](std::size_t begin, std::size_t end) {
        const std::size_t lanes = tables.lanes;
        std::vector<float> black(lanes), around(lanes);
        std::vector<std::vector<float>> row;  // (band)(slot, number) of the facets of a few targets
        for (const EyeRow& r : rows) row.emplace_back(GridPlaces::most * r.width(), 0.0f);
        GridPlaces places;
        TargetRows facets;
        for (std::size_t t0 = begin; t0 < end; t0 += GridPlaces::most) {
            const std::size_t count = std::min(GridPlaces::most, end - t0);
            find_places(grid, std::span(view.range).subspan(t0, count),
                        std::span(view.range_root).subspan(t0, count),
                        std::span(view.target_height).subspan(t0, count), places);
            std::uint32_t last = LitFacets::absent, slots = 0;
            for (std::size_t k = 0; k < count; ++k) {
                const std::uint32_t i = lit.target[t0 + k];
                if (t0 + k + ahead < end) sent.fetch(lit.target[t0 + k + ahead]);
                if (i != last) {
                    last = i;
                    black_modes(tables, state.temperature[i], black.data());
                    sent.around(i, black.data(), around.data());
                    const std::array<float, 3> up = height_weights(lit.height[i]);
                    for (std::size_t b = 0; b < rows.size(); ++b) {
                        rows[b].fill(&black[tables.first[b]], &around[tables.first[b]],
                                     lit.sky_view[i], state.sunlight[i], up,
                                     &row[b][slots * rows[b].width()]);
                    }
                    ++slots;
                }
                facets.slot[k] = slots - 1;
                facets.material[k] = lit.material[i];
            }
            for (std::size_t c = 0; c < columns; ++c) {
                eye_tables[c].look(places, facets, row[c / per_band].data(), count, columns,
                                   eye + t0 * columns + c);
            }
        }
    });
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
    if (!options.lit) own = lit_facets(input, view.facet, bands);
    const LitFacets& lit = options.lit ? *options.lit : *own;
    if (lit.worth.size() != bands.size() || lit.target.size() != view.facet.size()) {
        throw InputError("render", "the lit facets were found for another view or other bands");
    }
    const LitState state = lit_state(input, lit);
    const TemperatureExtent& extent = state.extent;
    const std::vector<BandState> prepared = prepare(bands, input, lit, extent);

    // What surfaces send to each other.
    std::vector<Channels> channels;
    std::vector<std::vector<std::vector<float>>> probe;
    std::vector<SpectralBasis> basis;
    std::vector<std::vector<NodeOptics>> optics;
    std::vector<std::array<Light, 3>> light;
    std::vector<BounceOptions> bounces;
    std::vector<std::optional<SunField>> scattered;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        channels.push_back(prepared[b].channels);
        probe.push_back(prepared[b].probes);
        basis.push_back(prepared[b].basis);
        optics.push_back(prepared[b].optics);
        light.push_back(prepared[b].light);
        scattered.push_back(prepared[b].scattered);
        bounces.push_back(bounce_options(bands[b], extent, light[b][2], scattered[b].has_value(),
                                         options.bounces, options.tolerance));
    }
    const LightTables tables =
        light_tables(bands, basis, optics, light, temperature_grid(extent.coldest, extent.hottest));
    const SentLight sent(lit, state, tables, bounces);

    // What the eye sees of them.
    const PathTable path(input.atmosphere, extent_of(view, input.ground_height_km), bands, channels,
                         probe, options.tolerance);
    std::vector<EyeTable> eye_tables;
    std::vector<EyeRow> rows;
    const std::size_t per_band = options.terms ? term_count : 1;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        rows.emplace_back(basis[b]);
        for (std::size_t t = 0; t < per_band; ++t) {
            TermSet terms = all_terms;
            if (options.terms) {
                terms.fill(false);
                terms[t] = true;
            }
            eye_tables.emplace_back(path, b, bands[b], channels[b], basis[b], optics[b], light[b],
                                    terms);
        }
    }
    // Surfaces as cold and as hot as any, in shade and in the sun.
    std::vector<std::vector<Eigen::MatrixXd>> worth(bands.size());
    for (std::size_t b = 0; b < bands.size(); ++b) {
        for (const float t : {extent.coldest, extent.hottest}) {
            const std::vector<float> row = rows[b].standing_for(tables, b, t, t == extent.hottest);
            for (std::size_t k = 0; k < per_band; ++k) {
                auto some = eye_tables[b * per_band + k].worth(row);
                if (k == 0) {
                    worth[b].insert(worth[b].end(), some.begin(), some.end());
                    continue;
                }
                for (std::size_t m = 0; m < some.size(); ++m) {
                    worth[b][worth[b].size() - some.size() + m] += some[m];
                }
            }
        }
    }
    const EyeGrid grid =
        eye_grid(path, input.ground_height_km, bands, worth, 0.5 * options.tolerance);
    for (EyeTable& table : eye_tables) table.refine(grid);
    const std::size_t columns = eye_tables.size();
    static_assert(sizeof(AtEye) == 3 * sizeof(float));
    ReusedFloats memory(view.facet.size() * columns * 3);
    auto* eye = reinterpret_cast<AtEye*>(memory.data());
    look(view, lit, state, tables, sent, rows, grid, eye_tables, eye);

    // What is seen where the scene ends is air, or ends in air: it counts as path, the last term.
    const auto behind = backgrounds(view, observer, bands, input, scattered);
    std::vector<const BackgroundTable*> background(columns, nullptr);
    for (std::size_t b = 0; b < behind.size(); ++b) {
        background[(b + 1) * per_band - 1] = &behind[b];
    }
    std::vector<std::vector<float>> planes(columns, std::vector<float>(view.pixels()));
    sum_pixels(view, {eye, view.facet.size() * columns}, background,
               axis_from_sun_deg(observer, input), planes);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        if (!scattered[b]) continue;
        frame.notes["scattered." + bands[b].name] = add_scattered_paths(
            view, observer, input, bands[b], *scattered[b], extent_of(view, input.ground_height_km),
            planes[(b + 1) * per_band - 1]);
    }

    if (options.hops && !options.hops->empty()) {
        const HopLight of_hops(*options.hops, options.plumes, view.observer_height, bands, input,
                               options.bounces, options.tolerance);
        of_hops.add(planes);
    }

    for (std::size_t b = 0; b < bands.size(); ++b) {
        const Band& band = bands[b];
        const std::span parts = std::span(planes).subspan(b * per_band, per_band);
        std::vector<float> radiance = options.terms ? sum_of(parts) : std::move(parts[0]);
        auto temperature = apparent_temperature(band, radiance);
        frame.planes.push_back({"radiance." + band.name, "W m-2 sr-1", std::move(radiance)});
        frame.planes.push_back({"apparent_temperature." + band.name, "K", std::move(temperature)});
        for (std::size_t t = 0; options.terms && t < term_count; ++t) {
            frame.planes.push_back({fmt::format("{}.{}", term_names[t], band.name), "W m-2 sr-1",
                                    std::move(parts[t])});
        }
        frame.notes["band." + band.name] =
            fmt::format("{:g} to {:g} um", band.from_um(), band.to_um());
        frame.notes["error." + band.name] = fmt::format(
            "{:.2g} mK from {} ranges, {} heights (straight between {} and {}), {} modes ({} of "
            "heat) "
            "of {} channels",
            1e3 * (path.error(b) + grid.error), path.ranges(), path.heights(), grid.ranges,
            grid.heights, basis[b].size(), basis[b].thermal, channels[b].size());
        frame.notes["bounces." + band.name] = fmt::format(
            "{} followed, the second at {} of {} facets; the rest is at most {:.2g} W m-2 sr-1",
            options.bounces, sent.followed(), lit.facet.size(),
            left_over(band, extent, light[b][2], scattered[b].has_value(), lit.worth[b],
                      options.bounces, bounces[b]));
    }
    if (options.truth) add_truth(view, input, frame);
    return frame;
}

}  // namespace diurna
