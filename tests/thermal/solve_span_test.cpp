#include "thermal/solve/solve_span.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/matter/library.hpp"
#include "materials/matter/read_library.hpp"
#include "tests/support/hill_world.hpp"
#include "tests/support/scratch_folder.hpp"
#include "thermal/solve/heat_state_file.hpp"
#include "thermal/solve/start_error.hpp"
#include "thermal/weather/repeated_day.hpp"

using namespace diurna;
using namespace hill_world;

namespace {

constexpr double hour = 3600.0, day = 86400.0;

/// The summer day of the hills, so many days long from `first` on.
Weather summers(double first_day, int days) {
    const Weather one = summer();
    Weather weather;
    for (int h = 0; h <= 24 * days; ++h) {
        weather.instant.push_back(later(june, day * first_day + hour * h));
        weather.sample.push_back(one.sample[std::size_t(h % 24)]);
    }
    return weather;
}

std::vector<Instant> every_half_hour(double from_h, double to_h) {
    std::vector<Instant> wanted;
    for (double h = from_h; h <= to_h + 1e-9; h += 0.5) wanted.push_back(later(june, hour * h));
    return wanted;
}

SolveInput input_of(const World& world) {
    static const SunExposure none;
    return {.facets = world.facets,
            .views = world.view,
            .sun = none,
            .materials = world.materials,
            .weather = world.weather,
            .site = tennessee,
            .elevation = 400.0};
}

ExposureOf exposure_of(const World& world) {
    return [&world](const std::vector<Instant>& instants) {
        return shadows(world.facets, world.rays, tennessee,
                       {.start = instants.front(),
                        .duration = seconds_between(instants.front(), instants.back())});
    };
}

SpanResult walk(const World& world, double from_h, double to_h, SpanStart begin) {
    SpanOptions options;
    options.start = later(june, hour * from_h);
    options.end = later(june, hour * to_h);
    options.begin = begin;
    options.wanted = every_half_hour(from_h, to_h);
    return solve_span(input_of(world), exposure_of(world), options);
}

/// [K] the largest difference between a day and another span at the same hours, from one hour of
/// the day to another.
double apart_by_hour(const TemperatureField& whole_day, const TemperatureField& part,
                     double from_h = 0.0, double to_h = 24.0) {
    double worst = 0.0;
    for (std::size_t i = 0; i < part.instant.size(); ++i) {
        const double since = std::fmod(seconds_between(june, part.instant[i]), day);
        if (since < from_h * hour || since > to_h * hour) continue;
        const std::vector<float> row = whole_day.interpolate(later(june, since));
        for (std::size_t f = 0; f < row.size(); ++f) {
            worst = std::max(worst, std::abs(double(row[f]) - double(part.at(i)[f])));
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("part of a day that repeats has the hours of the whole day", "[thermal][span]") {
    World world(8);
    const TemperatureField whole = world.run({.start = june, .keep_every = 600.0}).temperature;
    world.weather = summers(-1.0, 3);
    for (const SpanStart begin : {SpanStart::periodic, SpanStart::weather}) {
        const SpanResult morning = walk(world, 6.0, 18.0, begin);
        const SpanResult night = walk(world, 18.0, 24.0, begin);
        CAPTURE(int(begin), morning.start);
        CHECK(morning.report.converged);
        CHECK(morning.temperature.instant.size() == 25);
        CHECK(night.temperature.instant.size() == 13);
        CHECK(apart_by_hour(whole, morning.temperature) < 0.05);
        CHECK(apart_by_hour(whole, night.temperature) < 0.05);
    }
}

// Solar midnight is at 01:37 of the clock here: a file of one day may begin before or behind it.
TEST_CASE("part of a day that repeats begins where its file begins", "[thermal][span]") {
    World world(8);
    const TemperatureField whole = world.run({.start = june, .keep_every = 600.0}).temperature;
    const int first = GENERATE(-6, -3, 0, 1, 2, 3);
    CAPTURE(first);
    const Weather three = summers(-1.0, 3);
    world.weather = {};
    for (int h = first; h <= first + 24; ++h) {
        world.weather.instant.push_back(three.instant[std::size_t(24 + h)]);
        world.weather.sample.push_back(three.sample[std::size_t(24 + h)]);
    }
    const SpanResult morning = walk(world, 6.0, 18.0, SpanStart::known);
    CAPTURE(morning.start);
    CHECK(morning.report.converged);
    CHECK(apart_by_hour(whole, morning.temperature) < 0.05);
}

// The day before has no trend: it is that which was repeated, and is not stepped through again.
TEST_CASE("a span after days without a trend costs the repeated day and its own",
          "[thermal][span]") {
    World world(8);
    world.weather = summers(-1.0, 3);
    CHECK_FALSE(has_trend(world.weather, later(june, -day)));
    const SpanResult one = walk(world, 0.0, 24.0, SpanStart::weather);
    CHECK(one.report.converged);
    CHECK(one.report.steps == 2 * 144);
    for (Forcing& forcing : world.weather.sample) forcing.air.temperature += 1e-4;
    CHECK_FALSE(has_trend(world.weather, later(june, -day)));
    world.weather.sample[24].air.temperature += 1.0;
    CHECK(has_trend(world.weather, later(june, -day)));
    const SpanResult other = walk(world, 0.0, 24.0, SpanStart::weather);
    CHECK(other.report.steps == 3 * 144);
    CHECK(apart_by_hour(one.temperature, other.temperature) < 1.0);
}

TEST_CASE("what is requested of a span does not depend on where it is left", "[thermal][span]") {
    World world(8);
    world.weather = summers(-1.0, 3);
    SpanOptions options;
    options.start = june;
    options.end = later(june, 24.0 * hour);
    options.wanted = every_half_hour(0.0, 24.0);
    const SpanResult whole = solve_span(input_of(world), exposure_of(world), options);
    options.until = later(june, 9.0 * hour);
    const SpanResult part = solve_span(input_of(world), exposure_of(world), options);
    CHECK(part.temperature.instant.size() == 19);
    // Passes end where they change less than SolveOptions::settled.
    CHECK(apart_by_hour(whole.temperature, part.temperature) < 0.02);
}

TEST_CASE("days that repeat go on as they began", "[thermal][span]") {
    World world(8);
    const TemperatureField whole = world.run({.start = june, .keep_every = 600.0}).temperature;
    world.weather = summers(0.0, 3);
    const SpanResult days = walk(world, 0.0, 60.0, SpanStart::known);
    CAPTURE(days.start);
    CHECK(days.report.converged);
    CHECK(days.temperature.instant.size() == 121);
    // By day each sun comes 13 s after the one before, which changes up to 0.1 K where it grazes.
    CHECK(apart_by_hour(whole, days.temperature, 0.0, 4.0) < 0.005);
    CHECK(apart_by_hour(whole, days.temperature, 21.0, 24.0) < 0.005);
    CHECK(apart_by_hour(whole, days.temperature) < 0.3);
}

// A plate that conducts well has one temperature T, C dT/dt = h (T_air − T): air of 280 K for ever,
// then 290 K, straight within an hour.
TEST_CASE("a change of weather is followed from day to day as in closed form",
          "[thermal][span][by_comparison]") {
    const double film = 10.0, capacity = 0.5 * 2e6, lag = capacity / film, ramp = hour;
    World world(2);
    world.materials = MaterialLibrary({ground("plate", 1.0, 0.0, ConstantFilm{film},
                                              {{0.5, 1e4, 2000.0, 1000.0}}, FixedFlux{0.0})});
    for (MaterialId& id : world.facets.material) id = MaterialId{0};
    world.weather = {};
    for (int h = -72; h <= 96; ++h) {
        Forcing forcing;
        forcing.air = {
            .temperature = h <= 0 ? 280.0 : 290.0, .pressure = 96000.0, .vapour_pressure = 500.0};
        world.weather.instant.push_back(later(june, hour * h));
        world.weather.sample.push_back(forcing);
    }
    const SpanResult result = walk(world, 0.0, 72.0, SpanStart::known);
    CAPTURE(result.start);
    const double at_ramp = 280.0 + 10.0 * (1.0 - lag / ramp * (1.0 - std::exp(-ramp / lag)));
    for (std::size_t i = 0; i < result.temperature.instant.size(); ++i) {
        const double t = seconds_between(june, result.temperature.instant[i]);
        if (t < ramp) continue;
        const double exact = 290.0 + (at_ramp - 290.0) * std::exp(-(t - ramp) / lag);
        CAPTURE(t, exact);
        CHECK(result.temperature.at(i)[0] == Approx(exact).margin(0.01));
    }
}

TEST_CASE("a day that does not repeat is known, and its trend taken out", "[thermal][span]") {
    Weather front = summers(0.0, 1);
    CHECK(repeats(front, june));
    for (std::size_t i = 0; i < front.sample.size(); ++i) {
        front.sample[i].air.temperature -= 10.0 * double(i) / 24.0;
    }
    CHECK_FALSE(repeats(front, june));
    const Weather before = without_trend(front, june);
    CHECK(before.at(later(june, day)).air.temperature ==
          Approx(before.at(june).air.temperature).margin(1e-9));
    // Two days of it: the same hour of both days reports the trend, whatever the hour.
    Weather longer = summers(0.0, 3);
    for (std::size_t i = 0; i < longer.sample.size(); ++i) {
        longer.sample[i].air.temperature -= 10.0 * double(i) / 24.0;
    }
    const Instant seven = later(june, 7.0 * hour);
    const Weather level = without_trend(longer, seven);
    for (const double h : {0.0, 5.0, 12.0, 24.0}) {
        const Instant when = later(seven, hour * h);
        CHECK(level.at(when).air.temperature + 10.0 * 7.0 / 24.0 ==
              Approx(summers(0.0, 3).at(when).air.temperature).margin(1e-6));
    }
}

namespace {

/// 120 days before june and ten after, warm and cold by turns of 17 days, hourly.
Weather waves() {
    const Weather one = summer();
    Weather weather;
    for (int h = -120 * 24; h <= 10 * 24; ++h) {
        Forcing forcing = one.sample[std::size_t((h + 120 * 24) % 24)];
        const double turn = std::sin(2.0 * M_PI * h / (17.0 * 24.0) + 0.4);
        forcing.air.temperature += 6.0 * turn;
        forcing.air.vapour_pressure += 300.0 * turn;
        weather.instant.push_back(later(june, hour * h));
        weather.sample.push_back(forcing);
    }
    return weather;
}

SpanOptions two_days(SpanStart begin, int days_before) {
    SpanOptions options;
    options.start = june;
    options.end = later(june, 2.0 * day);
    options.begin = begin;
    options.days_before = days_before;
    options.wanted = {options.start, options.end};
    return options;
}

}  // namespace

// The truth: the same hills begun 120 days earlier. Level ground represents slopes to 30 degrees:
// the largest difference of any facet is reported within a factor of two.
TEST_CASE("the effect of the start is reported", "[thermal][span][start]") {
    World world(8);
    world.weather = waves();
    const SolveInput input = input_of(world);
    const ExposureOf exposure = exposure_of(world);
    const TemperatureField truth =
        solve_span(input, exposure, two_days(SpanStart::weather, 120)).temperature;
    for (const auto& [begin, days] :
         {std::pair{SpanStart::weather, 1}, std::pair{SpanStart::weather, 3},
          std::pair{SpanStart::periodic, 1}, std::pair{SpanStart::steady, 1}}) {
        const SpanOptions options = two_days(begin, days);
        const TemperatureField run = solve_span(input, exposure, options).temperature;
        const StartError messages_of = measure_start(input, options);
        for (const std::size_t i : {0, 1}) {
            double worst = 0.0;
            for (std::size_t f = 0; f < run.facets; ++f) {
                worst = std::max(worst, std::abs(double(run.at(i)[f]) - double(truth.at(i)[f])));
            }
            const double reported_worst = i == 0 ? messages_of.at_first : messages_of.at_later;
            CAPTURE(int(begin), days, i, reported_worst, worst, reported(messages_of));
            CHECK(messages_of.against == StartError::Against::more_days);
            CHECK(reported_worst > 0.5 * worst);
            CHECK(reported_worst < 2.0 * worst);
        }
    }
}

TEST_CASE("a start of which nothing better is known says so", "[thermal][span][start]") {
    World world(2);
    SolveInput input = input_of(world);
    SpanOptions options = two_days(SpanStart::known, 3);
    options.end = later(june, day);
    options.wanted = {options.start, options.end};
    const StartError repeated = measure_start(input, options);
    CHECK(repeated.against == StartError::Against::nothing);
    CHECK(reported(repeated).find("not included") != std::string::npos);
    options.begin = SpanStart::steady;  // at midnight the day's mean is far too warm
    const StartError steady = measure_start(input, options);
    CHECK(steady.against == StartError::Against::repeated_day);
    CHECK(steady.at_first > 3.0);
    CHECK(steady.at_later < 0.5 * steady.at_first);
}

// The state that a run leaves is where another goes on: two days in one are a day and a day.
TEST_CASE("a span continues from the state of another, to 1e-4 K", "[thermal][span][state]") {
    World world(6);
    world.weather = waves();
    const SolveInput input = input_of(world);
    const ExposureOf exposure = exposure_of(world);
    const SpanResult whole = solve_span(input, exposure, two_days(SpanStart::weather, 1));
    SpanOptions first = two_days(SpanStart::weather, 1);
    first.end = later(june, day);
    first.wanted = {first.end};
    first.goes_on = true;
    const SpanResult one = solve_span(input, exposure, first);
    const ScratchFolder folder("heat-state");
    const StateOwner owner{.mesh = "hills", .columns = {"soil: 3 m", "roof: 2 m"}};
    save_heat_state(folder.path / "state.nc", {first.end, one.end}, owner);
    const TimedState read = load_heat_state(folder.path / "state.nc", owner);
    CHECK(read.instant == first.end);
    CHECK(read.state.block == one.end.block);
    SpanOptions second = two_days(SpanStart::state, 1);
    second.start = first.end;
    second.wanted = {second.end};
    second.from = &read.state;
    const SpanResult two = solve_span(input, exposure, second);
    double worst = 0.0;
    for (std::size_t f = 0; f < two.temperature.facets; ++f) {
        worst = std::max(
            worst, std::abs(double(two.temperature.at(0)[f]) - double(whole.temperature.at(1)[f])));
    }
    CHECK(worst < 1e-4);

    CHECK_THROWS_WITH(load_heat_state(folder.path / "state.nc", {.mesh = "hill", .columns = {}}),
                      Catch::Contains("another mesh"));
    CHECK_THROWS_WITH(load_heat_state(folder.path / "state.nc",
                                      {.mesh = "hills", .columns = {"soil: 3 m", "roof: 1 m"}}),
                      Catch::Contains("'roof: 2 m' there is 'roof: 1 m' here"));
    std::ofstream(folder.path / "text.nc") << "not a state file";
    CHECK_THROWS_WITH(load_heat_state(folder.path / "text.nc", owner),
                      Catch::Contains("text.nc: is not a netCDF file"));
    std::filesystem::resize_file(folder.path / "state.nc", 2000);
    CHECK_THROWS_AS(load_heat_state(folder.path / "state.nc", owner), InputError);
}

// Ground that falls below freezing is solved by itself from the day on which it does, and goes on
// from what the day before left: a front of 15 K passes in the hour before.
// The day that repeats ends with what it began with, whatever hour the span ends at.
TEST_CASE("a part of a day that repeats leaves the heat of its own end", "[thermal][span][state]") {
    const World world(8);
    const TemperatureField whole = world.run({.start = june, .keep_every = 600.0}).temperature;
    for (const auto& [from_h, to_h] : {std::pair{0.0, 12.0}, {6.0, 13.5}}) {
        SpanOptions options;
        options.start = later(june, hour * from_h);
        options.end = later(june, hour * to_h);
        options.begin = SpanStart::periodic;
        options.wanted = every_half_hour(from_h, to_h);
        options.goes_on = true;
        const SpanResult first = solve_span(input_of(world), exposure_of(world), options);
        CAPTURE(first.start);
        options.begin = SpanStart::state;
        options.from = &first.end;
        options.start = options.end;
        options.end = later(june, hour * 20.0);
        options.wanted = every_half_hour(to_h, 20.0);
        const SpanResult rest = solve_span(input_of(world), exposure_of(world), options);
        CHECK(apart_by_hour(whole, rest.temperature) < 0.05);
    }
}

TEST_CASE("ground continues from day to day as it begins to freeze", "[thermal][span][frost]") {
    World world(2);
    const MaterialLibrary library = default_material_library();
    world.materials = MaterialLibrary({library[library.find("grass")]});
    for (MaterialId& id : world.facets.material) id = MaterialId{0};
    world.weather = {};
    for (int h = -72; h <= 48; ++h) {
        Forcing forcing;
        const double air = h < 24 ? 288.0 : 272.0;
        forcing.air = {.temperature = air, .pressure = 96000.0, .vapour_pressure = 400.0};
        forcing.longwave_down = h < 24 ? 370.0 : 300.0;
        forcing.wind_speed = 5.0;
        world.weather.instant.push_back(later(june, hour * h));
        world.weather.sample.push_back(forcing);
    }
    SpanOptions options;
    options.start = june;
    options.end = later(june, 2.0 * day);
    options.begin = SpanStart::known;
    for (int i = -6; i <= 6; ++i) options.wanted.push_back(later(june, day + 600.0 * i));
    const SpanResult two = solve_span(input_of(world), exposure_of(world), options);
    CHECK(two.report.points > 0);
    options.end = later(june, day);
    options.wanted = {options.end};
    const SpanResult one = solve_span(input_of(world), exposure_of(world), options);
    CHECK(one.report.points == 0);
    for (std::size_t f = 0; f < two.temperature.facets; ++f) {
        CAPTURE(f);
        CHECK(two.temperature.at(6)[f] == Approx(one.temperature.at(0)[f]).margin(0.01));
        for (std::size_t i = 6; i < 12; ++i) {  // steady cold: it cools on, ever more slowly
            const float now = two.temperature.at(i)[f], next = two.temperature.at(i + 1)[f];
            CHECK(next < now + 0.01f);
            CHECK(next > now - 1.0f);
        }
    }
}
