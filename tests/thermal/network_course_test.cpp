#include "thermal/network/network_course.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "materials/base/units.hpp"
#include "tests/support/triangle_sheet.hpp"
#include "thermal/network/network_step.hpp"

using namespace diurna;
using namespace diurna::testing;

namespace {

/// A wall and a plate of metal that face an enclosure, in a sun that comes and goes.
HeatNetwork wall_and_plate() {
    HeatNetwork network;
    network.column = {network_column({{0.1, 1.5, 2300.0, 880.0}}, FixedFlux{0.0}),
                      network_column({aluminium}, FixedFlux{0.0})};
    network.facet = {NetworkFacet{.column = 0, .area = 2.0, .radiant = 0.9},
                     NetworkFacet{.column = 1, .area = 2.0, .radiant = 0.9}};
    network.lump = {HeatLump{}, HeatLump{}};
    for (NetworkFacet& facet : network.facet) {
        facet.lump[behind_air] = 0;
        facet.lump[behind_star] = 1;
        facet.film = 3.0;
    }
    return network;
}

NetworkForcing sun(double watts, double begin, double step) {
    constexpr double film = 10.0, air = 290.0;
    const auto at = [=](double share) {
        return watts * std::pow(std::sin(std::numbers::pi * (begin + share * step) / 43200.0), 2);
    };
    return {.loads =
                [=](double share, NetworkLoads& to) {
                    to.outer = {0.7 * at(share), 0.0};
                },
            .faces =
                [=](double, const std::vector<double>& outer, const std::vector<double>&,
                    FaceFluxes& out) {
                    for (std::size_t f = 0; f < outer.size(); ++f) {
                        out.outer[f] = film * (air - outer[f]) +
                                       0.9 * stefan_boltzmann * (power4(air) - power4(outer[f]));
                        out.outer_slope[f] =
                            -film - 3.6 * stefan_boltzmann * std::pow(outer[f], 3.0);
                    }
                }};
}

/// Half a day in steps of ten minutes.
NetworkCount march(double watts, NetworkStepper& stepper) {
    constexpr double step = 600.0;
    stepper.settle(290.0);
    stepper.count = {};
    for (std::size_t i = 0; i < 72; ++i) {
        if (stepper.course != nullptr) stepper.course->begin_step(i, 2);
        stepper.advance(step, sun(watts, step * double(i), step));
    }
    return stepper.count;
}

}  // namespace

TEST_CASE("a march that knows an earlier one comes to the same with half the work",
          "[thermal][network]") {
    const HeatNetwork network = wall_and_plate();
    NetworkStepper alone(network), knowing(network);
    NetworkCourse course;
    knowing.course = &course;
    march(800.0, knowing);
    const double watts = GENERATE(800.0, 802.0);
    CAPTURE(watts);
    const NetworkCount once = march(watts, alone), again = march(watts, knowing);
    CAPTURE(once.newton, again.newton);
    CHECK(again.newton < 0.6 * double(once.newton));
    CHECK(again.worst_closure < 1e-8);
    // Both close 4e-9 of some 1000 W/m2, against 16 W/m2K, in each of 144 stages.
    for (std::size_t k = 0; k < alone.state.node.size(); ++k) {
        CHECK(knowing.state.node[k] == Approx(alone.state.node[k]).margin(144.0 * 4e-6 / 16.0));
    }
}

TEST_CASE("a march whose steps are divided otherwise begins its course again",
          "[thermal][network]") {
    NetworkCourse course;
    const NetworkState guess{.node = {280.0}, .lump = {}, .edge = {}},
        found{.node = {281.0}, .lump = {}, .edge = {}};
    course.begin_step(0, 1);
    course.store(guess, found);
    NetworkState next = guess;
    course.begin_step(0, 1);
    course.correct(next);
    CHECK(next.node[0] == Approx(281.0).margin(1e-4));
    course.begin_step(0, 2);
    next = guess;
    course.correct(next);
    CHECK(next.node[0] == 280.0);
    course.begin_step(0, 2);
    course.discard();
    course.begin_step(0, 2);
    course.correct(next);
    CHECK(next.node[0] == 280.0);
}
