#include "thermal/weather/cropped_weather.hpp"

#include <catch2/catch.hpp>

using namespace diurna;

namespace {

Weather minutes(Instant first, int rows) {
    Weather weather;
    for (int i = 0; i < rows; ++i) {
        weather.instant.push_back(later(first, 60.0 * i));
        Forcing row;
        row.air.temperature = 280.0 + 1e-5 * i;
        weather.sample.push_back(row);
    }
    return weather;
}

}  // namespace

TEST_CASE("of a long series the rows about the span stay, those before its start for 40 days",
          "[thermal][weather]") {
    const Instant first = parse_instant("2026-01-01T00:00:00Z");
    const Weather all = minutes(first, 200'000);  // 139 days
    const Instant from = later(first, 86400.0 * 60), to = later(from, 86400.0);
    const Weather kept = cropped(all, from, to);
    CHECK(seconds_between(kept.instant.front(), from) == Approx(40.0 * 86400.0));
    CHECK(seconds_between(to, kept.instant.back()) == Approx(3.0 * 86400.0));
    CHECK(kept.sample.size() == kept.instant.size());
    for (const double after : {-86400.0 * 33, 0.0, 4000.0, 86400.0}) {
        const Instant when = later(from, after);
        CHECK(kept.at(when).air.temperature == all.at(when).air.temperature);
    }
    // Beyond its ends a series stays as it ends.
    for (const double days : {-400.0, 400.0}) {
        const Instant when = later(first, 86400.0 * days);
        CHECK(cropped(all, when, later(when, 86400.0)).at(when).air.temperature ==
              all.at(when).air.temperature);
    }
    CHECK(cropped(minutes(first, 1000), from, to).instant.size() == 1000);
}
