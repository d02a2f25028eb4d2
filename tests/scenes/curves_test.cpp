#include "scenes/charts/curves.hpp"

#include <catch2/catch.hpp>

#include "scenes/charts/chart.hpp"
#include "scenes/charts/chart_layout.hpp"
#include "scenes/charts/time_axis.hpp"
#include "scenes/job/store/digest.hpp"

using namespace diurna;

namespace {

Material named(const std::string& name) {
    Material material;
    material.name = name;
    return material;
}

}  // namespace

TEST_CASE("a material's curve is its mean over area", "[scenes][curves]") {
    // Half of the grass is a level of its texture.
    Material darker = named("grass (albedo 0.15)");
    darker.varies = "grass";
    const MaterialLibrary materials({named("grass"), named("sand"), darker});
    FacetSet facets;
    facets.area = {1.0f, 3.0f, 2.0f};
    facets.material = {MaterialId{0}, MaterialId{2}, MaterialId{1}};
    const Instant start{};
    TemperatureField field;
    field.instant = {start, later(start, 3600.0)};
    field.facets = 3;
    field.kelvin = {280.0f, 284.0f, 290.0f, 300.0f, 296.0f, 290.0f};

    const auto curves = diurnal_curves(field, facets, material_groups(facets, materials));
    REQUIRE(curves.size() == 2);
    CHECK(curves[0].name == "grass");
    CHECK(curves[0].mean[0] == Approx((280.0 + 3 * 284.0) / 4));
    CHECK(curves[0].mean[1] == Approx((300.0 + 3 * 296.0) / 4));
    CHECK(curves[0].warmest() == 1);
    CHECK(curves[0].coldest() == 0);
    CHECK(curves[0].tenth == 296.0);
    CHECK(curves[0].ninetieth == 300.0);

    // 283 to 297 crosses 290 half-way.
    const auto crossed = crossovers(field.instant, curves[0], curves[1]);
    REQUIRE(crossed.size() == 1);
    CHECK(seconds_between(start, crossed[0]) == Approx(1800.0));
    CHECK(crossovers(field.instant, curves[0], curves[0]).empty());
}

TEST_CASE("names of lines make room for each other, as little as they can", "[scenes][chart]") {
    // Least squares by hand: two at one place go half a gap each, three about their mean.
    CHECK(spread({50.0, 50.0}, 15.0, 0.0, 100.0) == std::vector<double>{42.5, 57.5});
    CHECK(spread({60.0, 40.0, 50.0}, 15.0, 0.0, 100.0) == std::vector<double>{65.0, 35.0, 50.0});
    CHECK(spread({10.0, 90.0}, 15.0, 0.0, 100.0) == std::vector<double>{10.0, 90.0});
    // At an end they go the other way.
    CHECK(spread({99.0, 98.0, 100.0}, 15.0, 0.0, 100.0) == std::vector<double>{85.0, 70.0, 100.0});
    const std::vector<double> many = spread(std::vector<double>(20, 3.0), 5.0, 0.0, 100.0);
    for (std::size_t i = 0; i < many.size(); ++i) CHECK(many[i] == Approx(5.0 * double(i)));
}

TEST_CASE("what is far from the other lines has a scale of its own", "[scenes][chart]") {
    using Scales = std::vector<std::vector<std::size_t>>;
    // A pipe of 105 to 122 degrees among what goes from 11 to 70.
    CHECK(scales_apart({{11, 70}, {105, 122}, {15, 34}, {32, 55}}) == Scales{{1}, {0, 2, 3}});
    CHECK(scales_apart({{11, 70}, {20, 45}, {15, 34}, {32, 55}}) == Scales{{0, 1, 2, 3}});
    // One that is among them by night.
    CHECK(scales_apart({{10, 300}, {12, 40}, {15, 35}}) == Scales{{0}, {1, 2}});
    // From both ends; what is cold stands below.
    CHECK(scales_apart({{10, 40}, {500, 510}, {12, 38}, {-180, -170}, {11, 39}, {20, 30}}) ==
          Scales{{1}, {0, 2, 4, 5}, {3}});
    CHECK(scales_apart({{1, 2}}) == Scales{{0}});
    CHECK(scales_apart({}) == Scales{{}});
}

TEST_CASE("times in a row stand side by side, else without a text", "[scenes][chart]") {
    const auto texts = event_texts({0, 10, 20, 100, 190}, {47, 47, 47, 47, 47}, 200);
    CHECK(texts[0].level == 0);
    CHECK(texts[1].level == 1);
    CHECK(texts[2].level == -1);
    CHECK(texts[3].level == 0);
    CHECK(!texts[3].leftward);
    CHECK(texts[4].leftward);
    CHECK(texts[4].level == 1);  // the other's text ends at 147, its own begins at 143
    CHECK(shortened("Größe über alles", 6) == "Größe…");
    CHECK(letters_of("°C") == 2);
}

TEST_CASE("a clock's ticks are its whole hours and its days", "[scenes][chart]") {
    const Instant start = parse_instant("2026-07-15T00:30:00-04:00");
    const TimeAxis axis = time_axis(start, later(start, 12.0 * 3600.0), -4.0 * 3600.0);
    REQUIRE(axis.ticks.size() == 12);
    CHECK(axis.ticks[0].first == Approx(0.5));
    CHECK(axis.ticks[0].second == "01:00");
    CHECK(axis.ticks[11].second == "12:00");
    CHECK(axis.title == "scene's clock, UTC−04:00, from 15 July");
    CHECK(axis.says(parse_instant("2026-07-15T12:59:40Z")) == "09:00");
    const TimeAxis days = time_axis(start, later(start, 2.0 * 86400.0), 5.5 * 3600.0);
    REQUIRE(days.ticks.size() == 8);  // the clock begins at 10:00; every 6 h
    CHECK(days.ticks[0].second == "12:00");
    CHECK(days.ticks[2].second == "16 July");
    CHECK(days.says(start) == "15 July 10:00");
}

TEST_CASE("SHA-256 of the standard's examples", "[scenes][digest]") {
    // FIPS 180-2, appendix B.
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_CASE("a chart draws each line within its frame", "[scenes][chart]") {
    const std::string drawn =
        svg({.title = "t",
             .x_title = "h",
             .y_title = "degC",
             .x_last = 2.0,
             .lines = {{.name = "a", .colour = "#000000", .x = {0, 1, 2}, .y = {1, 5, 3}},
                       {.name = "b", .colour = "#ff0000", .x = {0, 2}, .y = {3, 3}}}});
    CHECK(drawn.find(">a</text>") != std::string::npos);
    CHECK(drawn.find(">b</text>") != std::string::npos);
    CHECK(drawn.find("nan") == std::string::npos);
    CHECK(drawn.rfind("</svg>\n") == drawn.size() - 7);
}
