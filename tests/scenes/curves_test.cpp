#include "scenes/report/curves.hpp"

#include <catch2/catch.hpp>

#include "scenes/kept/digest.hpp"
#include "scenes/report/chart.hpp"

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

    const auto curves = diurnal_curves(field, facets, materials);
    REQUIRE(curves.size() == 2);
    CHECK(curves[0].material == "grass");
    CHECK(curves[0].mean[0] == Approx((280.0 + 3 * 284.0) / 4));
    CHECK(curves[0].mean[1] == Approx((300.0 + 3 * 296.0) / 4));
    CHECK(curves[0].tenth[0] == 280.0);
    CHECK(curves[0].ninetieth[0] == 284.0);
    CHECK(curves[0].tenth[1] == 296.0);

    // 283 to 297 crosses 290 half-way.
    const auto crossed = crossovers(field.instant, curves[0], curves[1]);
    REQUIRE(crossed.size() == 1);
    CHECK(seconds_between(start, crossed[0]) == Approx(1800.0));
    CHECK(crossovers(field.instant, curves[0], curves[0]).empty());
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
