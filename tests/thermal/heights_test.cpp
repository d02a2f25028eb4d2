#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/hill_world.hpp"
#include "thermal/solve/solver.hpp"

// Facets at heights of their own under one station's weather: what they should have follows from
// the standard atmosphere, from formulas as published and from balances solved here.

using namespace diurna;
using namespace hill_world;

namespace {

constexpr double station = 200.0, film = 12.0;  // [m], [W m⁻² K⁻¹]
const AirState valley_air{.temperature = 303.0, .pressure = 98945.0, .vapour_pressure = 1500.0};

/// Level facets a metre wide, all of material 0, each with half of the next in view or none.
FacetSet level_facets(std::size_t count) {
    FacetSet facets;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = 10.0 * double(i);
        append_facets(facets, std::vector<Eigen::Vector3d>{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}},
                      std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}},
                      std::vector<MaterialId>{MaterialId{0}}, ObjectId{0});
    }
    return facets;
}
FacetViews whole_sky(std::size_t count) {
    FacetViews view;
    view.sky.assign(count, 1.0f);
    view.below.assign(count, 0.0f);
    view.others.row.assign(count + 1, 0);
    return view;
}

Weather still(double longwave = not_measured) {
    Forcing forcing;
    forcing.air = valley_air;
    forcing.wind_speed = 3.0;
    forcing.shortwave_down = 0.0;
    forcing.longwave_down = longwave;
    forcing.cloud_fraction = 0.0;
    return {.instant = {june}, .sample = {forcing}, .height = station};
}

Material plate(double emissivity, bool back = false) {
    Material material = ground("plate", 0.0, emissivity, ConstantFilm{film},
                               {{0.002, 400.0, 3000.0, 900.0}}, FixedFlux{0.0});
    if (back) material.thermal.back = ExposedBack{.emissivity = 0.5};
    return material;
}

struct Case {
    FacetViews view;
    std::vector<float> height;
    Material material = plate(1.0);
    AirByHeight rule;
    Weather weather = still();
    Method method = Method::modes;

    Case(FacetViews views, std::vector<float> heights)
        : view(std::move(views)), height(std::move(heights)) {
        rule.station = station;
    }
};
/// Temperatures at five o'clock after the start.
std::vector<double> settled(const Case& c) {
    const FacetSet facets = level_facets(c.view.sky.size());
    const SunExposure sun;
    const MaterialLibrary materials({c.material});
    const SolveResult result = solve({.facets = facets,
                                      .views = c.view,
                                      .sun = sun,
                                      .materials = materials,
                                      .weather = c.weather,
                                      .site = tennessee,
                                      .elevation = station,
                                      .by_height = &c.rule,
                                      .height = c.height,
                                      .clear_sky = {.longwave_by_direction = false}},
                                     {.start = june, .method = c.method});
    CHECK(result.report.converged);
    const auto kelvin = result.temperature.at(5);
    return {kelvin.begin(), kelvin.end()};
}

/// Dilley & O'Brien 1998, J. Geophys. Res. 103, 26151, model B, as published; vapour by Kunkel's
/// mean coefficient 0.379 km⁻¹.
double sky_at(double height) {
    const double t = 303.0 - 6.5e-3 * (height - station);
    const double e = 1500.0 * std::exp(-0.379e-3 * (height - station));
    const double water = 46.5 * (e / 100.0) / t;  // [kg m⁻²] Prata 1996, in mm
    return 59.38 + 113.7 * std::pow(t / 273.16, 6) + 96.96 * std::sqrt(10.0 * water / 25.0);
}

/// The root of gained + films · h (T_air − T) = emissivities · σ T⁴.
double balanced(double gained, double air, double films, double emissivities) {
    double low = 150.0, high = 500.0;
    for (int i = 0; i < 200; ++i) {
        const double t = 0.5 * (low + high);
        const double left =
            gained + films * film * (air - t) - emissivities * stefan_boltzmann * power4(t);
        (left > 0.0 ? low : high) = t;
    }
    return low;
}

}  // namespace

TEST_CASE("plateaus at 200 and 2700 m have the air and the sky of their heights",
          "[thermal][solver][heights]") {
    Case c(whole_sky(2), {200.0f, 2700.0f});
    c.method = GENERATE(Method::modes, Method::layered);
    // A clear summer night above 303 K: 16.25 K less air, 80 W/m² less sky on the upper one.
    const std::vector<double> t = settled(c);
    CHECK(t[0] == Approx(balanced(sky_at(200.0), 303.0, 1.0, 1.0)).margin(0.005));
    CHECK(t[1] == Approx(balanced(sky_at(2700.0), 286.75, 1.0, 1.0)).margin(0.005));
    // Facets that are solved one by one: here for a schedule of inner heat that is none.
    c.material.thermal.internal_schedule = {{0.0, 0.0}, {12.0, 0.0}, {24.0, 0.0}};
    const std::vector<double> single = settled(c);
    for (std::size_t i = 0; i < 2; ++i) CHECK(single[i] == Approx(t[i]).margin(0.005));
    // Thin sheets with air behind, whose surroundings there are as warm as the air.
    c.material = plate(0.9, true);
    const std::vector<double> sheet = settled(c);
    for (std::size_t i = 0; i < 2; ++i) {
        const double air = i == 0 ? 303.0 : 286.75;
        const double gained =
            0.9 * sky_at(double(c.height[i])) + 0.5 * stefan_boltzmann * power4(air);
        CHECK(sheet[i] == Approx(balanced(gained, air, 2.0, 1.4)).margin(0.005));
    }
}

// A sky is clear air with a share of black cloud (Crawford & Duchon 1999): the share is the same at
// every height, so that an overcast stays one and no sky is warmer than the air's black body.
TEST_CASE("measured longwave keeps its place between clear sky and black body",
          "[thermal][solver][heights]") {
    const auto black = [](double kelvin) { return stefan_boltzmann * power4(kelvin); };
    const double high = 303.0 - 9.75;
    const double share = GENERATE(0.2, 0.98);
    const double measured = std::lerp(sky_at(200.0), black(303.0), share);
    Case c(whole_sky(2), {200.0f, 1700.0f});
    c.weather = still(measured);
    const std::vector<double> t = settled(c);
    CHECK(t[0] == Approx(balanced(measured, 303.0, 1.0, 1.0)).margin(0.005));
    const double there = std::lerp(sky_at(1700.0), black(high), share);
    CHECK(t[1] == Approx(balanced(there, high, 1.0, 1.0)).margin(0.005));
}

TEST_CASE("the lapse may be given, reversed or zero", "[thermal][solver][heights]") {
    const auto at = [](double lapse, std::vector<float> height) {
        Case c(whole_sky(2), std::move(height));
        c.rule.lapse = lapse;
        c.weather = still(400.0);
        return settled(c);
    };
    const std::vector<double> none = at(0.0, {200.0f, 2700.0f}), flat = at(-6.5e-3, {});
    CHECK(none[1] == none[0]);
    CHECK(flat[0] == none[0]);
    const std::vector<double> inversion = at(20e-3, {200.0f, 300.0f});
    CHECK(inversion[1] > inversion[0] + 1.0);
}

TEST_CASE("temperatures go on from height to height without a step", "[thermal][solver][heights]") {
    std::vector<float> height;
    for (int i = 0; i <= 120; ++i) height.push_back(20.0f + 3.0f * float(i));
    const bool back = GENERATE(false, true);
    Case c(whole_sky(121), height);
    c.material = plate(0.95, back);
    const std::vector<double> t = settled(c);
    double worst = 0.0;
    for (std::size_t i = 1; i + 1 < t.size(); ++i) {
        worst = std::max(worst, std::abs(t[i + 1] - 2.0 * t[i] + t[i - 1]));
    }
    // Floats of 300 K are 3e-5 apart; sheets have one air for every two metres.
    CHECK(worst < (back ? 0.014 : 2e-4));
}

TEST_CASE("facets that face each other at two heights share the two skies",
          "[thermal][solver][heights][exchange]") {
    // Each sees half of its sky and half of the other, nothing flows into them and no air touches
    // them: E₁ = (L₁ + E₂) / 2 and E₂ = (L₂ + E₁) / 2, whatever the emissivity.
    FacetViews view;
    view.sky = {0.5f, 0.5f};
    view.below = {0.0f, 0.0f};
    view.others = {.row = {0, 1, 2}, .facet = {1, 0}, .factor = {0.5f, 0.5f}};
    Case c(view, {300.0f, 1900.0f});
    c.material = plate(GENERATE(1.0, 0.6));
    c.material.thermal.convection = ConstantFilm{0.0};
    const std::vector<double> t = settled(c);
    const double low = sky_at(300.0), high = sky_at(1900.0);
    CHECK(stefan_boltzmann * power4(t[0]) == Approx((2.0 * low + high) / 3.0).margin(0.1));
    CHECK(stefan_boltzmann * power4(t[1]) == Approx((2.0 * high + low) / 3.0).margin(0.1));
}
