#include "thermal/network/heat_network.hpp"

#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"
#include "tests/support/triangle_sheet.hpp"
#include "thermal/network/network_step.hpp"
#include "thermal/solve/network_period.hpp"

using namespace diurna;
using namespace diurna::testing;

namespace {}  // namespace

TEST_CASE("a sheet of one metal is one node, a wall is many", "[thermal][network]") {
    const NetworkColumn metal = network_column({aluminium}, FixedFlux{0.0});
    CHECK(metal.grid.size() == 1);
    CHECK(metal.grid.capacity[0] == Approx(0.002 * 2700.0 * 900.0));
    CHECK(metal.spread[0] == Approx(0.4));
    const NetworkColumn sandwich =
        network_column({aluminium, {0.05, 0.03, 30.0, 1400.0}, aluminium}, FixedFlux{0.0});
    CHECK(sandwich.grid.size() > 2);
    // Half of the foam's 0.0015 W/K belongs to each skin.
    CHECK(sandwich.spread[0] == Approx(0.4 + 0.00075));
    CHECK(sandwich.spread[1] == Approx(0.4 + 0.00075));
}

TEST_CASE("a linear temperature conducts as it should through any triangle", "[thermal][network]") {
    // T = x: through each side T's gradient times its outward normal times its length.
    const std::array<Eigen::Vector2d, 3> corner{{{0.1, 0.0}, {1.3, 0.2}, {0.4, 0.7}}};
    std::array<double, 3> side{}, at{}, expected{};
    for (int s = 0; s < 3; ++s) {
        const Eigen::Vector2d a = corner[(s + 1) % 3], b = corner[(s + 2) % 3];
        side[s] = (b - a).norm();
        at[s] = 0.5 * (a.x() + b.x());
        expected[s] = -(b - a).y();  // −∇T · (dy, −dx)
    }
    const Eigen::Vector2d p = corner[1] - corner[0], q = corner[2] - corner[0];
    const double area = 0.5 * (p.x() * q.y() - p.y() * q.x());
    const SidewaysFlow b = sideways_flow(side, area);
    const double middle = (corner[0].x() + corner[1].x() + corner[2].x()) / 3.0;
    const std::array<double, 3> away{middle - at[0], middle - at[1], middle - at[2]};
    CHECK(b[0] * away[0] + b[1] * away[1] + b[2] * away[2] == Approx(expected[0]));
    CHECK(b[1] * away[0] + b[3] * away[1] + b[4] * away[2] == Approx(expected[1]));
    CHECK(b[2] * away[0] + b[4] * away[1] + b[5] * away[2] == Approx(expected[2]));
}

TEST_CASE("a fin heated at its foot", "[thermal][network]") {
    const SheetError fin = heated_fin();
    CAPTURE(fin.largest, fin.worst);
    CHECK(fin.largest > 60.0);
    CHECK(fin.worst < 0.05);
    CHECK(fin.count.worst_closure < 1e-8);
    CHECK(fin.count.limited == 0);
}

TEST_CASE("a warm pattern fades on a plate of uneven triangles", "[thermal][network]") {
    const SheetError plate = fading_plate();
    CHECK(plate.largest < 12.0);
    CHECK(plate.worst < 0.05);
}

TEST_CASE("a thick rod cools through its end", "[thermal][network]") {
    // First mode of a slab, insulated behind: cos(z (1 - x / L)) exp(-z2 alpha t / L2), z tan z =
    // h L / k (Incropera 5.5). Concrete, 0.2 m, 15 W/m2K: Bi 2, z 1.07687.
    constexpr double thick = 0.2, k = 1.5, film = 15.0, air = 280.0;
    HeatNetwork rod;
    rod.column = {network_column({{thick, k, 2300.0, 880.0}}, FixedFlux{0.0})};
    rod.facet = {NetworkFacet{.area = 0.01}};
    double z = 1.07687;
    for (int i = 0; i < 5; ++i) {
        z -= (z * std::tan(z) - 2.0) / (std::tan(z) + z / (std::cos(z) * std::cos(z)));
    }
    NetworkStepper stepper(rod);
    const ColumnGrid& grid = rod.column[0].grid;
    for (std::size_t j = 0; j < grid.size(); ++j) {
        stepper.state.node[j] = air + 30.0 * std::cos(z * (1.0 - grid.depth[j] / thick));
    }
    for (int i = 0; i < 48; ++i) stepper.advance(300.0, in_air(air, film, 0.0));
    const double decay = std::exp(-z * z * k / (2300.0 * 880.0) * 14400.0 / (thick * thick));
    CHECK(stepper.state.node.front() == Approx(air + 30.0 * std::cos(z) * decay).margin(0.05));
    CHECK(stepper.state.node.back() == Approx(air + 30.0 * decay).margin(0.05));
}

TEST_CASE("two slabs in contact", "[thermal][network]") {
    // Equal half-spaces with a conductance of 200 W/m2K between them: about the middle each is one
    // with a film of 400 to the mean: exp(H2 alpha t) erfc(H sqrt(alpha t)), H = 400 / k (Carslaw &
    // Jaeger 2.7). Half an hour of 0.4 m of steel is a half-space's.
    constexpr double k = 50.0, heat = 7800.0 * 460.0;
    HeatNetwork slabs;
    slabs.column = {network_column({{0.6, k, 7800.0, 460.0}}, FixedFlux{0.0},
                                   {.period = 3600.0, .first = 0.02, .growth = 0.1})};
    slabs.lump = {HeatLump{}};
    // Turned about, so that fine cells meet: outer ends look at one another through a lump.
    slabs.facet = {NetworkFacet{.area = 0.5}, NetworkFacet{.area = 0.5}};
    NetworkStepper stepper(slabs);
    for (std::size_t f = 0; f < 2; ++f) {
        for (std::size_t n = stepper.system().node_of(f); n <= stepper.system().last_of(f); ++n) {
            stepper.state.node[n] = f == 0 ? 340.0 : 290.0;
        }
    }
    const NetworkForcing touch{.loads = {},
                               .faces = [](double, const std::vector<double>& outer,
                                           const std::vector<double>&, FaceFluxes& out) {
                                   for (std::size_t f = 0; f < 2; ++f) {
                                       out.outer[f] = 200.0 * (outer[1 - f] - outer[f]);
                                       out.outer_slope[f] = -200.0;
                                   }
                               }};
    for (int i = 0; i < 120; ++i) stepper.advance(10.0, touch);
    const double h = 400.0 / k, reach = k / heat * 1200.0;
    const double surface = 315.0 + 25.0 * std::exp(h * h * reach) * std::erfc(h * std::sqrt(reach));
    CHECK(stepper.state.node[0] == Approx(surface).margin(0.05));
    CHECK(stepper.state.node[stepper.system().node_of(1)] == Approx(630.0 - surface).margin(0.05));
}

TEST_CASE("two half-spaces that lie on each other part at their effusivities' mean",
          "[thermal][network]") {
    // Carslaw & Jaeger 2.15: concrete of 340 K on soil of 290 K meet at (e1 T1 + e2 T2) / (e1 +
    // e2), e = sqrt(k rho c), at once and for as long as neither feels its other end. What one
    // loses the other has: two facets of the one, different in size, on one of the other.
    const Layer concrete{
        .thickness = 1.0, .conductivity = 1.5, .density = 2300.0, .heat_capacity = 880.0};
    const Layer soil{
        .thickness = 1.0, .conductivity = 0.4, .density = 1600.0, .heat_capacity = 1000.0};
    HeatNetwork slabs;
    const GridOptions fine{.period = 3600.0, .first = 0.02, .growth = 0.1};
    slabs.column = {network_column({concrete}, FixedFlux{0.0}, fine),
                    network_column({soil}, FixedFlux{0.0}, fine)};
    slabs.facet = {NetworkFacet{.column = 0, .area = 0.3, .open = 0.0},
                   NetworkFacet{.column = 0, .area = 0.2, .open = 0.0},
                   NetworkFacet{.column = 1, .area = 0.5, .open = 0.0}};
    slabs.edges = 2;
    constexpr double film = 1e5;
    slabs.touch = {{0, 0, 2.0 * film * 0.3},
                   {1, 1, 2.0 * film * 0.2},
                   {2, 0, 2.0 * film * 0.3},
                   {2, 1, 2.0 * film * 0.2}};
    NetworkStepper stepper(slabs);
    stepper.settle(290.0);
    const NetworkSystem& system = stepper.system();
    for (std::size_t k = 0; k <= system.last_of(1); ++k) stepper.state.node[k] = 340.0;
    for (int i = 0; i < 120; ++i) stepper.advance(30.0, {});
    const double e1 = std::sqrt(1.5 * 2300.0 * 880.0), e2 = std::sqrt(0.4 * 1600.0 * 1000.0);
    const double meet = (e1 * 340.0 + e2 * 290.0) / (e1 + e2);
    for (std::size_t f = 0; f < 3; ++f) {
        CHECK(stepper.state.node[system.node_of(f)] == Approx(meet).margin(0.05));
    }
    double heat = 0.0, moved = 0.0;
    for (std::size_t f = 0; f < 3; ++f) {
        for (std::size_t k = system.node_of(f); k <= system.last_of(f); ++k) {
            const double j = slabs.facet[f].area *
                             slabs.grid_of(f).capacity[k - system.node_of(f)] *
                             (stepper.state.node[k] - (f < 2 ? 340.0 : 290.0));
            heat += j;
            moved += std::abs(j);
        }
    }
    CHECK(std::abs(heat) < 1e-8 * moved);
    CHECK(stepper.count.worst_closure < 1e-8);
}

TEST_CASE("two planes face each other across an enclosure", "[thermal][network]") {
    // q = sigma (T1^4 - T2^4) / (1 / e1 + 1 / e2 - 1); 300 W/m2 into the one, the other loses them
    // through a film of 20 to 280 K: T2 = 295 K.
    constexpr double e1 = 0.9, e2 = 0.3, heat = 300.0, film = 20.0, air = 280.0;
    const std::vector<double> factor = carroll_factors({2.0, 2.0});
    CHECK(factor[0] == Approx(2.0));
    HeatNetwork box;
    box.column = {network_column({aluminium}, FixedFlux{0.0})};
    box.lump = {HeatLump{}};
    box.facet = {
        NetworkFacet{
            .area = 2.0, .lump = {no_number, 0, no_number}, .radiant = radiant_share(2.0, e1)},
        NetworkFacet{
            .area = 2.0, .lump = {no_number, 0, no_number}, .radiant = radiant_share(2.0, e2)}};
    NetworkForcing forcing = in_air(air, film, 0.0);
    const auto faces = forcing.faces;
    forcing.faces = [faces](double share, const std::vector<double>& outer,
                            const std::vector<double>& inner, FaceFluxes& out) {
        faces(share, outer, inner, out);
        out.outer[0] = out.outer_slope[0] = 0.0;
    };
    forcing.loads = [](double, NetworkLoads& loads) { loads.outer[0] = heat; };
    NetworkStepper stepper(box);
    stepper.settle(air);
    for (int i = 0; i < 60; ++i) stepper.advance(7200.0, forcing);
    const double exchange = stefan_boltzmann / (1.0 / e1 + 1.0 / e2 - 1.0);
    const double cold = air + heat / film;
    const double warm = std::pow(std::pow(cold, 4.0) + heat / exchange, 0.25);
    CHECK(stepper.state.node[1] == Approx(cold).margin(0.01));
    CHECK(stepper.state.node[0] == Approx(warm).margin(0.05));
}

TEST_CASE("an engine warms up", "[thermal][network]") {
    // C dT/dt = P - G (T - T_air): P / G (1 - exp(-G t / C)).
    constexpr double power = 5000.0, leak = 60.0, capacity = 300.0 * 460.0, air = 283.0;
    HeatNetwork engine;
    engine.lump = {{.capacity = capacity}, {.fixed = true}};
    engine.link = {{0, 1, leak}};
    const NetworkForcing forcing{.loads =
                                     [](double, NetworkLoads& loads) {
                                         loads.lump[0] = power;
                                         loads.fixed[1] = air;
                                     },
                                 .faces = {}};
    NetworkStepper stepper(engine);
    stepper.settle(air);
    for (int i = 0; i < 20; ++i) stepper.advance(120.0, forcing);
    const double exact = air + power / leak * (1.0 - std::exp(-leak * 2400.0 / capacity));
    CHECK(exact - air > 50.0);
    CHECK(stepper.state.lump[0] == Approx(exact).margin(0.05));
}

TEST_CASE("coolant carries an engine's heat to its radiator", "[thermal][network]") {
    // Steady: all of P leaves through the radiator, T_r = T_air + P / G; the engine is warmer by
    // P / (m c), and the stream arrives as warm as it left.
    constexpr double power = 20000.0, stream = 1500.0, radiator = 400.0, air = 283.0;
    HeatNetwork loop;
    loop.lump = {{.capacity = 1e5}, {.capacity = 2e4}, {.fixed = true}};
    loop.link = {{1, 2, radiator}};
    loop.stream = {{0, 1, stream}, {1, 0, stream}};
    const NetworkForcing forcing{.loads =
                                     [](double, NetworkLoads& loads) {
                                         loads.lump[0] = power;
                                         loads.fixed[2] = air;
                                     },
                                 .faces = {}};
    NetworkStepper stepper(loop);
    stepper.settle(air);
    for (int i = 0; i < 100; ++i) stepper.advance(300.0, forcing);
    CHECK(stepper.state.lump[1] == Approx(air + power / radiator).margin(1e-3));
    CHECK(stepper.state.lump[0] == Approx(air + power / radiator + power / stream).margin(1e-3));
}

TEST_CASE("heat put in is heat stored, at any step", "[thermal][network][by_variation]") {
    for (const double step : {1.0, 60.0, 3600.0, 21600.0}) {
        Sheet plate = sheet(1.0, 1.0, 6, 6, network_column({aluminium}, FixedFlux{0.0}), 0.2);
        NetworkForcing forcing = in_air(280.0, 0.0, 0.0);
        forcing.loads = [](double, NetworkLoads& loads) { loads.outer[5] = 1000.0; };
        NetworkStepper stepper(plate.network);
        stepper.settle(280.0);
        for (int i = 0; i < 10; ++i) stepper.advance(step, forcing);
        double stored = 0.0;
        for (std::size_t f = 0; f < plate.network.facet.size(); ++f) {
            stored += plate.network.facet[f].area * 4860.0 * (stepper.state.node[f] - 280.0);
        }
        CAPTURE(step);
        CHECK(stored == Approx(1000.0 * plate.network.facet[5].area * 10.0 * step).epsilon(1e-8));
    }
}

TEST_CASE("a part that is held cold or hot is there at once", "[thermal][network]") {
    // In contact of 1e5 W/m2K with 160 or 1500 K, from 300: what a film of 20 W/m2K to 300 K
    // leaves, 20 / 1e5 of the difference.
    for (const double held : {160.0, 1500.0}) {
        HeatNetwork plate;
        plate.column = {network_column({aluminium}, FixedFlux{0.0})};
        plate.lump = {{.fixed = true}};
        plate.facet = {
            NetworkFacet{.area = 1.0, .lump = {no_number, no_number, 0}, .contact = 1e5}};
        NetworkForcing forcing = in_air(300.0, 20.0, 0.0);
        forcing.loads = [&](double, NetworkLoads& loads) { loads.fixed[0] = held; };
        NetworkStepper stepper(plate);
        stepper.settle(300.0);
        for (int i = 0; i < 4; ++i) stepper.advance(300.0, forcing);
        CHECK(stepper.state.node[0] == Approx(held + 2e-4 * (300.0 - held)).margin(0.01));
        CHECK(stepper.count.limited == 0);
    }
}

TEST_CASE("a period is found whatever its lumps take to follow", "[thermal][network]") {
    // A lump of rate λ to surroundings of 280 K, begun 20 K off, ends a day 20 exp(-λ P) off. Of
    // that the next start keeps a twelfth at most, and next to nothing where a lump takes weeks.
    constexpr double day = 86400.0, conductance = 5.0;
    HeatNetwork lumps;
    lumps.lump = {HeatLump{.fixed = true}};
    const std::vector<double> of_period{0.001, 0.1, 0.5, 2.2, 10.0, 100.0};  // λ P
    std::vector<double> start{280.0}, end{280.0};
    for (const double x : of_period) {
        lumps.link.push_back({0, std::uint32_t(lumps.lump.size()), conductance});
        lumps.lump.push_back({.capacity = conductance * day / x});
        start.push_back(300.0);
        end.push_back(280.0 + 20.0 * std::exp(-x));
    }
    NetworkPeriod period(lumps);
    const std::vector<double> next = period.next(start, end, day);
    CHECK(next[0] == 280.0);
    for (std::size_t k = 0; k < of_period.size(); ++k) {
        CAPTURE(of_period[k], next[k + 1]);
        CHECK(std::abs(next[k + 1] - 280.0) < 20.0 / 12.0);
        if (of_period[k] <= 0.1) CHECK(next[k + 1] == Approx(280.0).margin(0.05));
    }
    // And two that exchange: once more from there, by their own way through the day.
    HeatNetwork pair;
    pair.lump = {HeatLump{.fixed = true}, HeatLump{.capacity = 2e6}, HeatLump{.capacity = 4e7}};
    pair.link = {{0, 1, 20.0}, {1, 2, 40.0}};
    NetworkStepper stepper(pair);
    NetworkPeriod of_pair(pair);
    const NetworkForcing given{.loads =
                                   [](double, NetworkLoads& loads) {
                                       loads.fixed[0] = 280.0;
                                       loads.lump[2] = 100.0;
                                   },
                               .faces = {}};
    std::vector<double> begun{280.0, 300.0, 260.0};
    for (int i = 0; i < 4; ++i) {
        stepper.state.lump = begun;
        stepper.begin();
        of_pair.begin();
        for (int s = 0; s < 288; ++s) {
            stepper.advance(300.0, given);
            of_pair.add(stepper);
        }
        begun = of_pair.next(begun, stepper.state.lump, day);
    }
    CHECK(begun[1] == Approx(285.0).margin(0.01));  // 100 W over 20 W/K
    CHECK(begun[2] == Approx(287.5).margin(0.01));  // and over 40
}
