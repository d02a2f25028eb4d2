#include "scenes/studies/crossings.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

using namespace diurna;

namespace {

constexpr double day = 86400.0, turn = 2.0 * std::numbers::pi / day;

struct Sampled {
    std::vector<double> time, value;
};
Sampled sampled(const Difference& f, double step = 600.0, double end = day) {
    Sampled s;
    for (double t = 0.0; t <= end; t += step) {
        s.time.push_back(t);
        s.value.push_back(f(t));
    }
    return s;
}

std::vector<ZeroCrossing> found_in(const Difference& f, const CrossingSearch& search,
                                   double step = 600.0) {
    const Sampled s = sampled(f, step);
    return find_crossings(s.time, s.value, f, search);
}

}  // namespace

TEST_CASE("two sinusoids cross where their difference, a third, is zero",
          "[crossings][by_events]") {
    // a cos(wt - p) - b cos(wt - q) + c = R cos(wt - s) + c, zero at wt = s +- acos(-c/R).
    const double a = 12.0, p = turn * 13.5 * 3600, b = 5.0, q = turn * 15.0 * 3600, c = 1.7;
    const auto f = [&](double t) {
        return a * std::cos(turn * t - p) - b * std::cos(turn * t - q) + c;
    };
    const double x = a * std::cos(p) - b * std::cos(q), y = a * std::sin(p) - b * std::sin(q);
    const double r = std::hypot(x, y), s = std::atan2(y, x), half = std::acos(-c / r);
    std::vector<double> wanted;
    for (const double angle : {s - half, s + half}) {
        wanted.push_back(std::fmod(angle / turn + 2.0 * day, day));
    }
    std::sort(wanted.begin(), wanted.end());
    for (const double step : {600.0, 7200.0}) {
        const std::vector<ZeroCrossing> found =
            found_in(f, {.width = 0.5, .touching = 0.1, .jumping = 0.05}, step);
        REQUIRE(found.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(std::abs(found[i].at - wanted[i]) < 0.5);
            CHECK(found[i].kind == ZeroCrossing::Kind::crosses);
            const double slope = -r * turn * std::sin(turn * wanted[i] - s);
            CHECK(found[i].slope == Approx(slope).epsilon(1e-5));
        }
        CHECK(found[0].slope * found[1].slope < 0.0);
    }
}

TEST_CASE("touching, crossing twice between two times and staying apart are distinguished",
          "[crossings]") {
    // Its least is `gap` at 12:03, between two of the times.
    const auto dip = [](double gap) {
        return [gap](double t) { return gap + 10.0 * (1.0 - std::cos(turn * (t - 43380.0))); };
    };
    const CrossingSearch search{.width = 0.5, .touching = 0.1, .jumping = 0.05};
    const std::vector<ZeroCrossing> touches = found_in(dip(0.05), search);
    REQUIRE(touches.size() == 1);
    CHECK(touches[0].kind == ZeroCrossing::Kind::touches);
    CHECK(touches[0].least == Approx(0.05).margin(1e-4));
    CHECK(std::abs(touches[0].at - 43380.0) < 30.0);
    // Below zero for 2 acos(1 - gap / 10) / w about it: 55 s, far less than a step.
    const double gap = 2e-5;
    const std::vector<ZeroCrossing> through = found_in(dip(-gap), search);
    REQUIRE(through.size() == 2);
    const double half = std::acos(1.0 - gap / 10.0) / turn;
    CHECK(through[0].at == Approx(43380.0 - half).margin(1.0));
    CHECK(through[1].at == Approx(43380.0 + half).margin(1.0));
    CHECK(found_in(dip(0.2), search).empty());
    CHECK(found_in([&](double t) { return -dip(0.2)(t); }, search).empty());
    CHECK(found_in([](double) { return 0.0; }, search).empty());  // the same all the time
}

TEST_CASE("a jump is reported as one", "[crossings]") {
    const auto step = [](double t) { return t < 30123.4 ? -2.0 : 1.0; };
    const std::vector<ZeroCrossing> found =
        found_in(step, {.width = 0.5, .touching = 0.1, .jumping = 0.05});
    REQUIRE(found.size() == 1);
    CHECK(found[0].kind == ZeroCrossing::Kind::jumps);
    CHECK(std::abs(found[0].at - 30123.4) < 0.5);
    CHECK(found[0].slope > 0.0);
}

TEST_CASE("a crossing is found again where it has moved, or not at all", "[crossings]") {
    const double r = 8.0;
    const auto f = [&](double offset) {
        return [r, offset](double t) { return r * std::sin(turn * t) + offset; };
    };
    // At noon r sin goes down through zero; with an offset at pi + asin(offset / r).
    const ZeroCrossing noon{.at = 43200.0, .slope = -r * turn};
    for (const double offset : {-4.0, -0.5, 0.001, 0.5, 4.0}) {
        const auto found = nearest_crossing(noon, f(offset), 3 * 3600.0, 0.0, day, 0.5);
        REQUIRE(found);
        CHECK(std::abs(*found - (43200.0 + std::asin(offset / r) / turn)) < 0.5);
    }
    CHECK(!nearest_crossing(noon, f(7.0), 3 * 3600.0, 0.0, day, 0.5));   // 4 h off
    CHECK(!nearest_crossing(noon, f(9.0), 12 * 3600.0, 0.0, day, 0.5));  // never
    CHECK(!nearest_crossing(noon, f(4.0), 3 * 3600.0, 0.0, 44000.0, 0.5));
}

TEST_CASE("time near zero is that of straight lines", "[crossings]") {
    const std::vector<double> time{0.0, 100.0, 200.0, 300.0}, value{-10.0, 10.0, 10.0, 0.5};
    CHECK(time_below(time, value, 1.0) == Approx(10.0 + 100.0 * 0.5 / 9.5));
    CHECK(time_below(time, value, 20.0) == Approx(300.0));
    CHECK(time_below(time, std::vector<double>(4, 0.0), 1.0) == Approx(300.0));
}
