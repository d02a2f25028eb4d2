#include "scenes/studies/combined_heat.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/heat.hpp"
#include "tests/support/heated_plate.hpp"

// Temperatures of scenes with several numbers changed, from those with one changed at a time; and
// solves that start from those of a similar scene.

using namespace diurna;

namespace {

/// Two facets at three hours: T = 280 + f(x) + g(y), the second facet half of it.
template <class F, class G>
TemperatureField field(double x, double y, const F& f, const G& g) {
    const Instant start = parse_instant("2026-07-15T00:00:00Z");
    TemperatureField made{.instant = {}, .facets = 2, .kelvin = {}};
    for (int hour = 0; hour < 3; ++hour) {
        made.instant.push_back(later(start, 3600.0 * hour));
        const double risen = (1.0 + hour) * (f(x) + g(y));
        made.kelvin.push_back(float(280.0 + risen));
        made.kelvin.push_back(float(280.0 + 0.5 * risen));
    }
    return made;
}

}  // namespace

TEST_CASE("combined temperatures are exact for numbers that act alone, to second order",
          "[scenes][combined]") {
    // Ranges 0 to 1; the scene has 0.4 and 0: a parabola, and a line from an end.
    const auto f = [](double x) { return 4.0 * (x - 0.4) - 3.0 * (x - 0.4) * (x - 0.4); };
    const auto g = [](double y) { return 2.0 * y; };
    const TemperatureField base = field(0.4, 0.0, f, g);
    CombinedHeat combined(base);
    REQUIRE(combined.add({.low = field(0.0, 0.0, f, g),
                          .middle = field(0.5, 0.0, f, g),
                          .high = field(1.0, 0.0, f, g),
                          .has_middle = true}));
    REQUIRE(combined.add({.high = field(0.4, 1.0, f, g)}));
    for (const double x : {0.0, 1.0 / 3.0, 0.8, 1.0}) {
        for (const double y : {0.0, 0.25, 1.0}) {
            CAPTURE(x, y);
            CHECK(difference_of(combined.at({x, y}), field(x, y, f, g)).worst < 1e-4);
        }
    }
    CHECK(combined.departure({0.0, 0.0}) < combined.departure({0.0, 1.0}));
    // Of other facets: refused.
    TemperatureField other = base;
    other.facets = 1;
    CHECK_FALSE(combined.add({.low = other}));
}

TEST_CASE("an interaction is the error of combined temperatures", "[scenes][combined]") {
    const auto none = [](double) { return 0.0; };
    const auto with = [&](double x, double y) {
        return field(
            x, y, [&](double) { return x + y + 0.8 * x * y; }, none);
    };
    const TemperatureField base = with(0.0, 0.0);
    CombinedHeat combined(base);
    REQUIRE(combined.add({.high = with(1.0, 0.0)}));
    REQUIRE(combined.add({.high = with(0.0, 1.0)}));
    const FieldDifference apart = difference_of(combined.at({1.0, 1.0}), with(1.0, 1.0));
    // 0.8 K at the first facet by hours 1, 2, 3, and half of it: rms of these.
    CHECK(apart.worst == Approx(2.4).margin(1e-4));
    CHECK(apart.rms == Approx(0.8 * std::sqrt(14.0 / 3.0 * 1.25 / 2.0)).margin(1e-4));
}

TEST_CASE("a solve that starts from a similar one has the same temperatures",
          "[scenes][combined]") {
    const ScratchFolder folder("similar_solves");
    lay_heated_plate(folder, "");
    const auto scene = [&](const std::vector<std::string>& settings) {
        Scene read = read_scene(folder.path / "scene.toml", settings, true);
        read.time.every_step = true;
        return prepare(std::move(read));
    };
    Progress quiet{ProgressTo{}};
    const Prepared base = scene({}), changed = scene({"material.black.internal_heat_W_m2=310.0"});
    const Stages of_base(base), of_changed(changed);
    const SolvedScene first = solve_scene(of_base, quiet, {}, {.keep_course = true});
    REQUIRE_FALSE(first.course.piece.empty());
    const SolvedScene alone = solve_scene(of_changed, quiet);
    const SolvedScene led = solve_scene(of_changed, quiet, {}, {.like = &first.course});
    CHECK(led.report.converged);
    CHECK(difference_of(alone.temperature, led.temperature).worst < 2e-3);
    CHECK(difference_of(alone.temperature, first.temperature).worst > 1.0);
    // And itself again.
    const SolvedScene again = solve_scene(of_base, quiet, {}, {.like = &first.course});
    CHECK(difference_of(again.temperature, first.temperature).worst < 1e-3);
}
