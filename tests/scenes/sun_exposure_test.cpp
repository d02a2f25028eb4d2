#include "scenes/job/run/sun_exposure.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <utility>

#include "scenes/job/input/scene_file.hpp"
#include "tests/support/small_scene.hpp"

// Days of a span that take over what the days around them agree on, against each worked out in
// full.

using namespace diurna;

namespace {

constexpr double step = 600.0;  // [s]

Prepared small() {
    const ScratchFolder folder("sun-exposure");
    write_text(folder.path / "scene.toml", small_scene());
    return prepare(read_scene(folder.path / "scene.toml"));
}

std::vector<Instant> day_from(Instant start) {
    std::vector<Instant> instants;
    for (int i = 0; i <= 144; ++i) instants.push_back(later(start, step * i));
    return instants;
}

struct Difference {
    double mean = 0.0;     // of |share - share|, over instants and facets
    double changed = 0.0;  // share of these that differ by a quarter and more
    double late_s = 0.0;   // root mean square over edges that both have [s]
};

Difference difference(const SunExposure& a, const SunExposure& b) {
    Difference d;
    for (std::size_t i = 0; i < a.fraction.size(); ++i) {
        const double off = std::abs(a.fraction[i] - b.fraction[i]);
        d.mean += off;
        d.changed += off >= 0.25 ? 1.0 : 0.0;
    }
    d.mean /= double(a.fraction.size());
    d.changed /= double(a.fraction.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, float> edges;
    for (const ShadowEdge& edge : b.edge) edges[{edge.step, edge.facet}] = edge.share;
    double both = 0.0;
    for (const ShadowEdge& edge : a.edge) {
        const auto found = edges.find({edge.step, edge.facet});
        if (found == edges.end()) continue;
        d.late_s += std::pow(step * (edge.share - found->second), 2.0);
        both += 1.0;
    }
    CHECK(both > 0.95 * double(b.edge.size()));
    d.late_s = std::sqrt(d.late_s / both);
    return d;
}

}  // namespace

// By midsummer the sun moves 1.25 degrees in a week, by the equinox in three days.
TEST_CASE("days of a span have the sun that each has by itself", "[scenes][sun]") {
    const Prepared prepared = small();
    const char* const start = GENERATE("2026-07-15T00:00:00-04:00", "2026-03-18T00:00:00-04:00");
    CAPTURE(start);
    const Instant first = parse_instant(start);
    DailySunExposure daily(prepared, later(first, 7.0 * 86400.0));
    for (int day = 0; day < 7; ++day) {
        CAPTURE(day);
        const std::vector<Instant> instants = day_from(later(first, 86400.0 * day));
        const SunExposure sun = daily.of(instants), full = scene_sun_exposure(prepared, instants);
        REQUIRE(sun.instant == full.instant);
        REQUIRE(sun.fraction.size() == full.fraction.size());
        const Difference d = difference(sun, full);
        CHECK(d.mean < 5e-4);
        CHECK(d.changed < 5e-4);
        CHECK(d.late_s < 20.0);  // what each is looked for to
        if (day == 0) CHECK(sun.fraction == full.fraction);
    }
    CHECK(daily.share_taken_over() > 0.4);
    INFO(daily.share_taken_over());
}

TEST_CASE("a day that is requested again is not computed again", "[scenes][sun]") {
    const Prepared prepared = small();
    const Instant first = parse_instant("2026-07-15T00:00:00-04:00");
    DailySunExposure daily(prepared, later(first, 2.0 * 86400.0));
    std::vector<Instant> instants = day_from(first);
    const SunExposure whole = daily.of(instants);
    CHECK(daily.share_taken_over() == 0.0);
    CHECK(daily.of(instants).fraction == whole.fraction);
    CHECK(daily.share_taken_over() == 0.5);
    // Half a day of it, with the edges of its own steps alone.
    instants.resize(73);
    const SunExposure half = daily.of(instants);
    CHECK(half.instant == instants);
    CHECK(half.fraction.size() == 73 * prepared.world.surfaces().size());
    CHECK(half.edge.back().step < 72);
    // Other hours are worked out in full.
    for (Instant& when : instants) when = later(when, 300.0);
    CHECK(daily.of(instants).fraction == scene_sun_exposure(prepared, instants).fraction);
}
