#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/library.hpp"
#include "thermal/solver.hpp"
#include "thermal/sun_exposure.hpp"

using namespace diurna;

namespace {

const Site tennessee{.latitude_deg = 36.5, .longitude_deg = -84.2, .height = 400.0};
const Instant june = parse_instant("2026-06-21T05:00:00Z");  // midnight there

/// Facet f stands in the shade from gone[f] to back[f] [s after midnight], at no round instants.
constexpr std::size_t facets = 6;
constexpr double gone[facets]{31397.0, 34555.0, 40009.0, 46951.0, 52345.0, 58888.0};
constexpr double back[facets]{38303.0, 36019.0, 52711.0, 47777.0, 61234.0, 59999.0};

float in_the_sun(std::size_t f, double t) { return t >= gone[f] && t < back[f] ? 0.0f : 1.0f; }

void fraction_at(Instant when, std::span<const std::uint8_t> chosen, std::span<float> fraction) {
    const double t = seconds_between(june, when);
    for (std::size_t f = 0; f < facets; ++f) {
        if (chosen[f]) fraction[f] = in_the_sun(f, t);
    }
}

SunExposure sampled(const SolveOptions& options) {
    SunExposure sun{.instant = step_instants(options), .fraction = {}};
    const std::vector<std::uint8_t> all(facets, 1);
    for (std::size_t i = 0; i < sun.instant.size(); ++i) {
        sun.fraction.resize((i + 1) * facets);
        fraction_at(sun.instant[i], all, std::span(sun.fraction).last(facets));
    }
    return sun;
}

}  // namespace

TEST_CASE("a shadow's edge is found to seconds, and none where there is none",
          "[thermal][shadow]") {
    const SolveOptions options{.start = june};
    SunExposure sun = sampled(options);
    find_edges(sun, fraction_at, {.tolerance = 2.0});
    // Two for each facet; but who goes and comes back within one step is not seen.
    REQUIRE(sun.edge.size() == 2 * facets);
    for (const ShadowEdge& edge : sun.edge) {
        const double t = 600.0 * (edge.step + double(edge.share));
        const double off = std::min(std::abs(t - gone[edge.facet]), std::abs(t - back[edge.facet]));
        CAPTURE(edge.facet, edge.step, edge.share);
        CHECK(off <= 2.0);
    }
    CHECK(std::is_sorted(sun.edge.begin(), sun.edge.end(),
                         [](const auto& a, const auto& b) { return a.step < b.step; }));
}

// The reference knows nothing of edges or modes: nodes, in steps of a second, to each of which the
// sun is on or off.
TEST_CASE("10-minute steps follow shadows as 1 s steps of the layered column do",
          "[thermal][shadow][solver]") {
    const MaterialLibrary materials = default_material_library();
    FacetSet ground;
    std::vector<MaterialId> used;
    for (const char* name : {"grass", "forest", "bare_soil", "rock", "asphalt", "painted_steel"}) {
        used.push_back(materials.find(name));
    }
    for (std::size_t f = 0; f < facets; ++f) {
        const double east = 20.0 * double(f);
        append_facets(
            ground, std::vector<Eigen::Vector3d>{{east, 0, 0}, {east + 10, 0, 0}, {east, 10, 0}},
            std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}, {&used[f], 1}, ObjectId{0});
    }
    SkyView open{.sky_view = std::vector<float>(facets, 1.0f),
                 .below = std::vector<float>(facets, 0.0f),
                 .exchange = {}};
    open.exchange.row.assign(facets + 1, 0);
    Weather weather;
    for (int h = 0; h <= 24; ++h) {
        const double wave = std::cos(2.0 * M_PI * (h - 15) / 24.0);
        Forcing f;
        f.air = {.temperature = 297.0 + 6.0 * wave, .pressure = 97000.0, .vapour_pressure = 1500.0};
        f.wind_speed = 2.5 + 1.5 * wave;
        weather.instant.push_back(later(june, 3600.0 * h));
        weather.sample.push_back(f);
    }
    const auto run = [&](SolveOptions options, bool edges) {
        SunExposure sun = sampled(options);
        if (edges) find_edges(sun, fraction_at, {.tolerance = 1.0});
        return solve({.facets = ground,
                      .sky_view = open,
                      .sun = sun,
                      .materials = materials,
                      .weather = weather,
                      .site = tennessee},
                     options)
            .temperature;
    };
    const TemperatureField reference = run({.start = june,
                                            .step = 1.0,
                                            .keep_every = 600.0,
                                            .tolerance = 1e-3,
                                            .method = Method::layered,
                                            .grid = {.first = 0.0125, .growth = 0.08}},
                                           false);
    const SolveOptions ten_minutes{.start = june, .keep_every = 600.0};
    const auto worst = [&](const TemperatureField& field) {
        double most = 0.0;
        for (std::size_t k = 0; k < field.kelvin.size(); ++k) {
            most = std::max(most, std::abs(double(field.kelvin[k]) - reference.kelvin[k]));
        }
        return most;
    };
    const double split = worst(run(ten_minutes, true)),
                 sampled_only = worst(run(ten_minutes, false));
    CAPTURE(split, sampled_only);
    CHECK(split < 0.1);
    // What edges are for: without them the light is kelvins wrong.
    CHECK(sampled_only > 1.0);
}
