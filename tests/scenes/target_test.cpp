#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"
#include "scenes/job/world/targets.hpp"
#include "tests/support/target_scene.hpp"

using namespace diurna;
using namespace diurna::testing::target_scene;
namespace over_plain = diurna::testing::over_plain;

TEST_CASE("a hot floor warms the lid above it", "[scenes][target]") {
    // Outside nothing but a film of 10 W/m2K to 290 K. Inside, floor held at 340 K, lid 0.9 and 0.9
    // two centimetres above it: sigma (340^4 - T^4) / (2 / 0.9 - 1) = 10 (T - 290), and no film: T
    // = 307.4 K (bisection). Without an enclosure the lid is as warm as the air.
    const over_plain::Given given{
        .mesh = box(4, 0.02), .height = 2.0, .albedo = 1.0, .black = 0.0, .ground_edge = 5.0};
    const Solved on = solved(given, R"([[object.part]]
name = "floor"
inside = "gap"
inner_emissivity = 0.9
temperature_K = 340.0
[[object.part]]
name = "lid"
inside = "gap"
inner_emissivity = 0.9
welded = false
[[object.part]]
name = "sides"
inside = "gap"
inner_emissivity = 0.0
welded = false
[[object.enclosure]]
name = "gap"
volume_m3 = 0.32
air_changes_per_h = 0
film_W_m2K = 0
)");
    const double x = 200.0, root = std::sqrt(1.0 + x * x);
    const double f = 2.0 / (std::numbers::pi * x * x) *
                     (0.5 * std::log(root * root * root * root / (1.0 + 2.0 * x * x)) +
                      2.0 * x * root * std::atan(x / root) - 2.0 * x * std::atan(x));
    double low = 290.0, high = 340.0;
    for (int i = 0; i < 60; ++i) {
        const double t = 0.5 * (low + high);
        const double in = stefan_boltzmann * (std::pow(340.0, 4) - std::pow(t, 4)) /
                          (0.2 / 0.9 + 2.0 / (1.0 + f));
        (in > 10.0 * (t - 290.0) ? low : high) = t;
    }
    CHECK(on.kelvin("12:00", "lid") == Approx(low).margin(0.05));
    CHECK(on.kelvin("12:00", "floor") == Approx(340.0).margin(0.05));
    CHECK(on.result.report.worst_energy_closure < 1e-8);
    CHECK(on.result.report.converged);
}

TEST_CASE("what lies over a very hot lid is as warm as it should be",
          "[scenes][target][by_extreme]") {
    // 20 kW/m2 in the lid of a target, two metres under the floor of an ordinary box: aligned
    // squares at half their size see F = 0.4153 of one another (Howell C-11), else the lid sees a
    // sky of nothing and the floor ground of some 280 K. Radiosities J = e sigma T^4 + (1 - e) H;
    // 20000 = 10 (T1 - 290) + J1 - H1, H2 - J2 = 10 (T2 - 290); e 0.9.
    const over_plain::Given given{
        .mesh = box(4, 0.02), .height = 2.0, .albedo = 1.0, .black = 0.9, .ground_edge = 5.0};
    const Solved on = solved(given, R"([[object.part]]
name = "lid"
heat_W_m2 = 20000.0
welded = false
[[object.part]]
name = "*"
[[object]]
name = "over"
mesh = "mesh.obj"
up = "z"
place_m = [0.0, 0.0]
height_above_ground_m = 4.02
largest_edge_m = 2.0
material = "sheet"
)",
                             6.0);
    const double f = 0.4153, e = 0.9, ground = stefan_boltzmann * std::pow(280.0, 4);
    double t1 = 700.0, t2 = 500.0;
    for (int i = 0; i < 4000; ++i) {
        const double b1 = e * stefan_boltzmann * std::pow(t1, 4),
                     b2 = e * stefan_boltzmann * std::pow(t2, 4), back = 1.0 - e;
        // J1 = b1 + back f J2, J2 = b2 + back (f J1 + (1 - f) ground)
        const double j1 =
            (b1 + back * f * (b2 + back * (1.0 - f) * ground)) / (1.0 - back * back * f * f);
        const double h2 = f * j1 + (1.0 - f) * ground, j2 = b2 + back * h2;
        t1 += 1e-3 * (20000.0 - 10.0 * (t1 - 290.0) - j1 + f * j2);
        t2 += 1e-3 * (h2 - j2 - 10.0 * (t2 - 290.0));
    }
    CAPTURE(t1, t2);
    CHECK(t1 > 700.0);
    CHECK(on.result.report.converged);
    CHECK(on.kelvin("05:00", "lid") == Approx(t1).epsilon(0.01));
}

TEST_CASE("an engine runs by the clock", "[scenes][target]") {
    // Its heat leaves through the lid alone: P = 10 W/m2K 16 m2 (T - 290) once all is steady;
    // before it runs, and hours after, all is as warm as the air.
    const over_plain::Given given{
        .mesh = box(4, 0.5), .height = 2.0, .albedo = 1.0, .black = 0.0, .ground_edge = 5.0};
    const Solved on = solved(given, R"([[object.part]]
name = "*"
[[object.part]]
name = "lid"
welded = false
[[object.lump]]
name = "engine"
heat_capacity_J_K = 20000.0
heat_W = 3200.0
hours = ["06:00-12:00 1.0", "12:00-14:00 0.5"]
[[object.link]]
between = ["engine", "lid"]
film_W_m2K = 20.0
)");
    CHECK(on.kelvin("05:50", "lid") == Approx(290.0).margin(0.05));
    CHECK(on.kelvin("11:50", "lid") == Approx(310.0).margin(0.05));
    CHECK(on.kelvin("13:50", "lid") == Approx(300.0).margin(0.05));
    CHECK(on.kelvin("11:50", "floor") == Approx(290.0).margin(0.05));
}

TEST_CASE("a steady start knows a target's sources", "[scenes][target]") {
    // 200 W/m2 for half of the day in a lid of 16 m2 whose film of 10 W/m2K leads to 290 K: in the
    // mean 10 K over it, and all that the engine's link carries besides, 1600 W: 10 K more.
    const over_plain::Given given{
        .mesh = box(4, 0.5), .height = 2.0, .albedo = 1.0, .black = 0.0, .ground_edge = 5.0};
    const Solved on = solved(given, R"([[object.part]]
name = "*"
[[object.part]]
name = "lid"
welded = false
heat_W_m2 = 200.0
hours = ["06:00-18:00"]
[[object.lump]]
name = "engine"
heat_capacity_J_K = 20000.0
heat_W = 1600.0
[[object.link]]
between = ["engine", "lid"]
film_W_m2K = 20.0
)",
                             24.0, 2.0, "spin_up = \"steady\"\n");
    CHECK(on.kelvin("00:00", "lid") == Approx(310.0).margin(0.05));
    CHECK(on.kelvin("00:00", "floor") == Approx(290.0).margin(0.05));
    CHECK(on.kelvin("05:50", "lid") == Approx(300.0).margin(0.05));
}

TEST_CASE("a hot plate warms the ground that it lies on", "[scenes][target]") {
    // A box whose floor is held at 340 K, 1 cm over level ground, 20 W/m2K between them; nothing
    // but a film of 10 W/m2K to 290 K besides. Ground that it covers by a share s goes to where 20
    // s (340 - T) = 10 (1 - s) (T - 290): plates of a millimetre are there within hours.
    const over_plain::Given given{
        .mesh = box(4, 0.5), .height = 0.01, .albedo = 1.0, .black = 0.0, .ground_edge = 1.0};
    const Solved on = solved(given, R"([[object.part]]
name = "*"
[[object.part]]
name = "floor"
welded = false
temperature_K = 340.0
[[object.contact]]
between = ["floor", "ground"]
conductance_W_m2K = 20.0
)");
    const FacetSet& facets = on.prepared.world.facets;
    const std::vector<float> all =
        on.result.temperature.interpolate(parse_instant("2026-03-20T12:00:00Z"));
    std::size_t covered = 0, partly = 0;
    double worst = 0.0;
    for (std::size_t f = 0; f < on.prepared.world.ground_facets; ++f) {
        constexpr int fine = 1000;
        int within = 0, points = 0;
        std::array<Eigen::Vector3d, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) {
            corner[k] = facets.vertex[facets.corner[f][k]].cast<double>();
        }
        if (corner[0].head<2>().norm() > 20.0) continue;
        for (int i = 0; i < fine; ++i) {
            for (int j = 0; i + j < fine; ++j) {
                const double a = (i + 1.0 / 3.0) / fine, b = (j + 1.0 / 3.0) / fine;
                const Eigen::Vector3d p =
                    corner[0] + a * (corner[1] - corner[0]) + b * (corner[2] - corner[0]);
                within += std::abs(p.x()) < 2.0 && std::abs(p.y()) < 2.0 ? 1 : 0;
                ++points;
            }
        }
        const double share = double(within) / points;
        covered += share == 1.0;
        partly += share > 0.0 && share < 1.0;
        const double expected = (20.0 * share * 340.0 + 10.0 * (1.0 - share) * 290.0) /
                                (20.0 * share + 10.0 * (1.0 - share));
        worst = std::max(worst, std::abs(double(all[f]) - expected));
    }
    CAPTURE(covered, partly);
    CHECK(covered + partly > 4);
    CHECK(worst < 0.05);  // shares by points: 0.1 % of 50 K
    CHECK(on.result.report.worst_energy_closure < 1e-8);
    CHECK(on.result.report.converged);
}

TEST_CASE("what a heater gives a box on the ground leaves through faces in the open",
          "[scenes][target][fluxes]") {
    // Millimetre plates in steady air and sky store nothing: the rows of all facets times their
    // areas sum to the heater's 2 kW, and covered faces have none.
    const over_plain::Given given{
        .mesh = box(4, 0.5), .height = 0.01, .longwave = 350.0, .black = 0.9, .ground_edge = 1.0};
    const Solved on = solved(given, R"([[object.part]]
name = "*"
inside = "room"
[[object.part]]
name = "floor"
inside = "room"
[[object.enclosure]]
name = "room"
volume_m3 = 8.0
air_changes_per_h = 0
[[object.lump]]
name = "heater"
heat_capacity_J_K = 1000.0
heat_W = 2000.0
[[object.link]]
between = ["heater", "room"]
conductance_W_K = 50.0
[[object.contact]]
between = ["floor", "ground"]
conductance_W_m2K = 20.0
)",
                             24.0, 2.0, "spin_up = \"steady\"\n", "[output]\nfluxes = true\n");
    const FacetSet& facets = on.prepared.world.facets;
    const HeatFluxField& heat = on.result.heat;
    REQUIRE(!heat.empty());
    double left = 0.0, below = 0.0;
    const std::size_t row = (heat.instant.size() - 1) * heat.facets;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (facets.centroid[f].head<2>().norm() > 30.0f) continue;  // as in the open
        const double area = double(facets.area[f]);
        left -= area * double(heat.of(HeatTerm::conducted)[row + f]);
        const bool floor = f >= on.prepared.world.ground_facets && facets.normal[f].z() < -0.9f;
        if (!floor) continue;
        for (std::size_t k = 0; k < heat_terms; ++k) {
            below = std::max(below, std::abs(double(heat.watts[k][row + f])));
        }
    }
    CHECK(left == Approx(2000.0).epsilon(0.002));
    CHECK(below < 1e-3);
    CHECK(on.result.report.converged);
}
