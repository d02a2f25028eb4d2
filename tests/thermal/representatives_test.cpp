#include "thermal/solve/representatives.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "tests/support/hill_world.hpp"

using namespace diurna;
using namespace hill_world;

namespace {

/// The hills, and behind them each facet again under the same sky, seeing the second hills as the
/// first sees the first, with half of what it sees handed to the first.
struct Twice {
    FacetSet facets;
    FacetViews view;
    Representatives who;

    explicit Twice(const World& world) : facets(world.facets), view(world.view) {
        const std::size_t n = world.facets.size();
        const auto again = [](auto& values) {
            const auto once = values;
            values.insert(values.end(), once.begin(), once.end());
        };
        again(facets.corner);
        again(facets.centroid);
        again(facets.normal);
        again(facets.area);
        again(facets.material);
        again(facets.object);
        again(view.sky);
        again(view.below);
        again(view.hidden);
        again(view.rays);
        again(view.shares);
        view.others = {.row = {0}, .facet = {}, .factor = {}};
        const ViewFactors& once = world.view.others;
        for (std::size_t f = 0; f < 2 * n; ++f) {
            for (std::uint32_t k = once.row[f % n]; k < once.row[f % n + 1]; ++k) {
                const auto seen = static_cast<std::uint32_t>(once.facet[k]);
                for (const std::uint32_t copy : {seen, static_cast<std::uint32_t>(n) + seen}) {
                    view.others.facet.push_back(copy);
                    view.others.factor.push_back(0.5f * once.factor[k]);
                }
            }
            view.others.row.push_back(static_cast<std::uint32_t>(view.others.facet.size()));
        }
        who.solved.resize(n);
        std::iota(who.solved.begin(), who.solved.end(), 0u);
        for (std::size_t f = 0; f < 2 * n; ++f) who.place.push_back(std::uint32_t(f % n));
    }
};

}  // namespace

// A representative in a world of two equal hills is that world once, to the bit.
TEST_CASE("hills that represent similar ones are those hills alone", "[thermal][solver]") {
    const World world(8);
    const SolveOptions options{.start = june};
    const SunExposure shade = shadows(world.facets, world.rays, tennessee, options);
    const Twice twice(world);
    const std::size_t n = world.facets.size();
    const SolveInput whole{.facets = twice.facets,
                           .views = twice.view,
                           .sun = shade,  // not used
                           .materials = world.materials,
                           .weather = world.weather,
                           .site = tennessee,
                           .elevation = 400.0};
    const SolvedPart part(whole, twice.who);
    CHECK(part.input().views.others.facet == world.view.others.facet);
    CHECK(part.input().views.others.factor == world.view.others.factor);

    const SpanOptions span{.day = options,
                           .start = june,
                           .end = later(june, 86400.0),
                           .begin = SpanStart::periodic,
                           .wanted = {june, later(june, 43200.0)},
                           .heat = true};
    const auto of = [](const SunExposure& exposure) {
        return [&exposure](const std::vector<Instant>&) { return exposure; };
    };
    const SolveInput alone{.facets = world.facets,
                           .views = world.view,
                           .sun = shade,
                           .materials = world.materials,
                           .weather = world.weather,
                           .site = tennessee,
                           .elevation = 400.0};
    const SpanResult expected = solve_span(alone, of(shade), span);
    SpanResult found = solve_span(part.input(), of(shade), span);
    CHECK(found.temperature.kelvin == expected.temperature.kelvin);
    spread(twice.who, found);
    REQUIRE(found.temperature.facets == 2 * n);
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t f = 0; f < 2 * n; ++f) {
            REQUIRE(found.temperature.at(i)[f] == expected.temperature.at(i)[f % n]);
        }
    }
    REQUIRE(found.heat.facets == 2 * n);
    const auto& conducted = found.heat.of(HeatTerm::conducted);
    CHECK(conducted[2 * n + n + 3] == expected.heat.of(HeatTerm::conducted)[n + 3]);
}

TEST_CASE("snow and water of representative facets lie on the represented ones",
          "[thermal][solver]") {
    const Representatives who{.solved = {1, 3}, .place = {0, 0, 1, 1, 0}};
    SpanResult result;
    result.temperature.instant = {june, later(june, 600.0)};
    result.temperature.facets = 2;
    result.temperature.kelvin = {280.0f, 290.0f, 281.0f, 291.0f};
    result.temperature.water.facet = {1};
    result.temperature.water.cover.resize(2);
    result.temperature.water.cover[1].wet = 0.5f;
    spread(who, result);
    CHECK(result.temperature.kelvin ==
          std::vector<float>{280, 280, 290, 290, 280, 281, 281, 291, 291, 281});
    CHECK(result.temperature.water.facet == std::vector<std::uint32_t>{2, 3});
    REQUIRE(result.temperature.water.cover.size() == 4);
    CHECK(result.temperature.water.at(0)[1].wet == 0.0f);
    CHECK(result.temperature.water.at(1)[0].wet == 0.5f);
    CHECK(result.temperature.water.at(1)[1].wet == 0.5f);
}
