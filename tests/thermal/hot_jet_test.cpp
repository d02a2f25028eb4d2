#include "thermal/surface/hot_jet.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/air/moist_air.hpp"
#include "materials/air/transport.hpp"

using namespace diurna;
using Eigen::Vector3d;

namespace {

/// Just warmer than the air, so that the gas is as dense as it.
constexpr HotJet tepid{
    .diameter = 0.1, .speed = 15.0, .temperature = 290.0, .air_temperature = 288.0};

struct Numbers {
    double conductivity, reynolds, prandtl;
};
Numbers numbers(const HotJet& jet) {
    const double kelvin = 0.5 * (jet.temperature + jet.air_temperature);
    const double viscosity = air_viscosity(kelvin), conductivity = air_conductivity(kelvin);
    const double density = jet.pressure / (287.05 * kelvin);
    return {conductivity, jet.speed * jet.diameter * density / viscosity,
            1005.0 * viscosity / conductivity};
}

/// Mean over a circle of a level plate under the jet, of the film, or of film times warmth.
double mean(const HotJet& jet, double height, double radius, bool of_heat = false) {
    constexpr int rings = 4000;
    double sum = 0.0;
    for (int k = 0; k < rings; ++k) {
        const double r = radius * (k + 0.5) / rings;
        const JetFilm film =
            jet_film(jet, -Vector3d::UnitZ(), {r, 0.0, -height}, Vector3d::UnitZ(), true);
        sum += (of_heat ? film.film * film.warmth : film.film) * 2.0 * r / rings / radius;
    }
    return sum;
}

}  // namespace

TEST_CASE("a jet's film on a plate has Martin's mean", "[thermal][jet][by_comparison]") {
    // Martin 1977, as in Incropera et al., Fundamentals of Heat and Mass Transfer, 7.7: G of the
    // relative nozzle area A = D^2 / 4 r^2.
    const double speed = GENERATE(1.0, 15.0, 120.0), apart = GENERATE(2.0, 4.0, 6.0, 9.0, 12.0),
                 radius = GENERATE(2.5, 4.0, 7.5);
    CAPTURE(speed, apart, radius);
    HotJet jet = tepid;
    jet.speed = speed;
    const auto [conductivity, reynolds, prandtl] = numbers(jet);
    CAPTURE(reynolds);
    const double area = 1.0 / (4.0 * radius * radius), root = std::sqrt(area);
    const double g = 2.0 * root * (1.0 - 2.2 * root) / (1.0 + 0.2 * (apart - 6.0) * root);
    const double nusselt = g * 2.0 * std::sqrt(reynolds) *
                           std::sqrt(1.0 + 0.005 * std::pow(reynolds, 0.55)) *
                           std::pow(prandtl, 0.42);
    CHECK(mean(jet, apart * 0.1, radius * 0.1) ==
          Approx(nusselt * conductivity / 0.1).epsilon(0.002));
}

TEST_CASE("others measured about the same film under a jet", "[thermal][jet]") {
    // Goldstein, Behbahani & Heppelmann 1986 (Int. J. Heat Mass Transfer 29, 1227), constant heat
    // flux: Nu / Re^0.76 = (24 - |L/D - 7.75|) / (533 + 44 (R/D)^1.285), Re 61 000 to 124 000.
    // Correlations of impinging jets differ by a fifth.
    const double apart = GENERATE(6.0, 7.75, 12.0), radius = GENERATE(2.5, 5.0, 7.5);
    CAPTURE(apart, radius);
    const auto [conductivity, reynolds, prandtl] = numbers(tepid);
    REQUIRE(reynolds > 61000.0);
    REQUIRE(reynolds < 124000.0);
    const double nusselt = std::pow(reynolds, 0.76) * (24.0 - std::abs(apart - 7.75)) /
                           (533.0 + 44.0 * std::pow(radius, 1.285));
    CHECK(mean(tepid, apart * 0.1, radius * 0.1) ==
          Approx(nusselt * conductivity / 0.1).epsilon(0.2));
}

TEST_CASE("a free jet is as warm on its axis as measured", "[thermal][jet]") {
    // Chen & Rodi's review (1980): 5 D/x of the outlet's excess beyond the core.
    for (const auto& [x, share] : {std::pair{10.0, 0.5}, {20.0, 0.25}, {40.0, 0.125}}) {
        CHECK(free_jet(tepid, 0.1 * x, 0.0).warmth == Approx(share).epsilon(0.01));
        CHECK(free_jet(tepid, 0.1 * x, 0.0).speed == Approx(0.62 * 10.0 / x).epsilon(0.01));
    }
    CHECK(free_jet(tepid, 0.2, 0.0).warmth == 1.0);
    CHECK(free_jet(tepid, -0.1, 0.0).warmth == 0.0);
    // Twice as hot, half as dense: as of an outlet 1 / √2 as wide.
    HotJet hot = tepid;
    hot.temperature = 576.0;
    CHECK(free_jet(hot, 2.0, 0.0).warmth == Approx(0.25 / std::sqrt(2.0)));
}

TEST_CASE("a free jet keeps its heat and its momentum", "[thermal][jet]") {
    // Of the mean flow; the fluctuations carry the rest, a tenth to a sixth of either (Fischer et
    // al. 1979, 9.2; Papanicolaou & List 1988, J. Fluid Mech. 195, 341).
    const double x = GENERATE(1.5, 3.0, 6.0);
    double heat = 0.0, momentum = 0.0;
    for (double r = 5e-4; r < x; r += 1e-3) {
        const FreeJet at = free_jet(tepid, x, r);
        heat += at.speed * at.warmth * 2.0 * std::numbers::pi * r * 1e-3;
        momentum += at.speed * at.speed * 2.0 * std::numbers::pi * r * 1e-3;
    }
    const double outlet = 0.25 * std::numbers::pi * 0.01;
    CHECK(heat / outlet > 0.8);
    CHECK(heat / outlet < 1.0);
    CHECK(momentum / outlet > 0.83);
    CHECK(momentum / outlet < 1.0);
}

TEST_CASE("a jet gives a wall less heat than it has", "[thermal][jet]") {
    const double apart = GENERATE(2.0, 6.0, 12.0, 30.0), diameter = GENERATE(0.03, 0.1, 0.5),
                 speed = GENERATE(5.0, 30.0, 100.0);
    const HotJet jet{.diameter = diameter, .speed = speed, .temperature = 700.0};
    const double radius = 60.0 * diameter;
    const double given =
        mean(jet, apart * diameter, radius, true) * std::numbers::pi * radius * radius;
    CAPTURE(apart, diameter, speed, given, heat_flow(jet));
    CHECK(given > 0.0);
    CHECK(given < heat_flow(jet));
}

TEST_CASE("a jet that leans warms the ground ahead of it more", "[thermal][jet]") {
    const HotJet jet{.diameter = 0.1, .speed = 30.0, .temperature = 600.0};
    const Vector3d down = Vector3d(1.0, 0.0, -1.0).normalized();
    const auto at = [&](double x, double y) {
        const JetFilm film = jet_film(jet, down, {0.6 + x, y, -0.6}, Vector3d::UnitZ(), true);
        return film.film * film.warmth;
    };
    CHECK(at(0.8, 0.0) > 1.3 * at(0.0, 0.8));
    CHECK(at(0.0, 0.8) > 2.0 * at(-0.8, 0.0));
    CHECK(at(0.0, 0.8) == Approx(at(0.0, -0.8)));
    // Continuous through the stagnation point and over the core's edge.
    CHECK(at(1e-6, 0.0) == Approx(at(-1e-6, 0.0)).epsilon(1e-3));
    CHECK(at(0.2499, 0.0) == Approx(at(0.2501, 0.0)).epsilon(0.01));
}

TEST_CASE("a jet blows on what lies before it, as far as it reaches", "[thermal][jet]") {
    const HotJet jet{.diameter = 0.1, .speed = 30.0, .temperature = 600.0};
    const Vector3d ahead = Vector3d::UnitX(), up = Vector3d::UnitZ();
    const auto film = [&](const Vector3d& place, const Vector3d& normal, bool met = false) {
        return jet_film(jet, ahead, place, normal, met).film;
    };
    CHECK(film({1.0, 0.0, -0.05}, up) > 5.0);      // a plate beside it
    CHECK(film({-0.5, 0.0, 0.0}, -ahead) == 0.0);  // behind the outlet
    CHECK(film({1.0, 0.0, 0.0}, ahead) == 0.0);    // turned away
    CHECK(film({1.0, 0.0, -0.8}, up) == 0.0);      // beside its cone
    CHECK(film({1.01 * jet_reach(jet), 0.0, 0.0}, -ahead, true) == 0.0);
    CHECK(film({1.0, 0.0, 0.0}, -ahead) > film({4.0, 0.0, 0.0}, -ahead));
    // Along a plate: Incropera's 7.36 at the jet's own speed, 0.62 u at ten diameters.
    const auto [conductivity, reynolds, prandtl] = numbers(jet);
    const double speed = 6.2 * std::sqrt(288.15 / 600.0) / 10.0;
    CHECK(film({1.0, 0.0, 0.0}, up) == Approx(0.0296 * std::pow(speed * reynolds * 10.0, 0.8) *
                                              std::cbrt(prandtl) * conductivity)
                                           .epsilon(0.002));
    CHECK(mass_flow(jet) == Approx(101325.0 / (287.05 * 600.0) * 30.0 * 0.007853982).epsilon(1e-6));
    CHECK(speed_of(mass_flow(jet), jet) == Approx(30.0));
}
