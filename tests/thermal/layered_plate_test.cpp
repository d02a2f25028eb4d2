#include <catch2/catch.hpp>
#include <cmath>

#include "thermal/steppers/plate_batch.hpp"

using namespace diurna;

namespace {

constexpr double film = 12.0, air_temperature = 290.0;

/// A plate in still air: nothing but a constant film on both faces.
ThermalSurface plate(Layer layer) {
    ThermalSurface surface;
    surface.emissivity = 0.0;
    surface.convection = ConstantFilm{film};
    surface.layers = {layer};
    surface.back = ExposedBack{.emissivity = 0.0, .albedo = 1.0};
    return surface;
}

AirFilm still_air(const ThermalSurface& surface) {
    const AirState air{.temperature = air_temperature, .pressure = 1e5, .vapour_pressure = 1000.0};
    return air_film(surface, louis_form(0.01, 0.001, 10.0, 2.0), air, 1.0);
}

/// One plate, its nodes as warm as the air.
struct One {
    ThermalSurface surface;
    AirFilm air = still_air(surface);
    PlateStep step;
    PlateBatch batch;
    StepRecord record;

    One(Layer layer, double seconds, double heat)
        : surface(plate(layer)),
          step(make_plate_step(column_grid(surface.layers, FixedFlux{0.0}), air_temperature, film,
                               film, seconds)) {
        batch.resize(step.modes(), 1);
        const std::vector<double> on(lanes, heat);
        begin_plates(step, surface, air, on.data(), batch);
    }
    double advance(double heat_before, double heat, std::vector<HeatJump> jumps = {}) {
        const std::vector<double> before(lanes, heat_before), now(lanes, heat);
        advance_plates(step, surface, {air, air, before.data(), now.data(), jumps}, batch, record);
        return batch.temperature[0][0] - air_temperature;
    }
};

}  // namespace

// Heat q on the front of a slab between two films: q = h (θ_f + θ_b), k/d (θ_f − θ_b) = h θ_b.
TEST_CASE("a heated board settles at the temperatures of its two films in series",
          "[thermal][plate]") {
    const Layer board{0.02, 0.15, 600.0, 1700.0};
    One one(board, 3600.0, 500.0);
    double front = 0.0;
    for (int i = 0; i < 60; ++i) front = one.advance(500.0, 500.0);
    const double link = board.conductivity / board.thickness;
    const double back = 500.0 / film / (2.0 + film / link);
    CHECK(one.batch.temperature[1][0] - air_temperature == Approx(back).epsilon(1e-9));
    CHECK(front == Approx(back * (1.0 + film / link)).epsilon(1e-9));
    CHECK(one.record.worst_closure < 1e-12);
}

// A sheet too thin to be unevenly warm: C θ' = q − 2 h θ. Its time constant is 244 s.
TEST_CASE("sheet steel warms by its exponential in steps of any length",
          "[thermal][plate][by_variation][by_comparison]") {
    const Layer steel{0.0015, 45.0, 7800.0, 500.0};
    const double rate = 2.0 * film / (0.0015 * 7800.0 * 500.0), warmest = 500.0 / (2.0 * film);
    for (const double step : {1.0, 60.0, 600.0, 3600.0}) {
        One one(steel, step, 500.0);
        double theta = 0.0;
        for (int i = 0; i < 3; ++i) theta = one.advance(500.0, 500.0);
        CAPTURE(step);
        // Front and back are 8 mK apart.
        CHECK(theta == Approx(warmest * -std::expm1(-rate * 3.0 * step)).margin(0.01));
    }
}

TEST_CASE("a jump of heat within a step is taken at its instant", "[thermal][plate]") {
    const Layer steel{0.0015, 45.0, 7800.0, 500.0};
    const double rate = 2.0 * film / (0.0015 * 7800.0 * 500.0), warmest = 500.0 / (2.0 * film);
    for (const double share : {0.1, 0.37, 0.9}) {
        One one(steel, 600.0, 0.0);
        const double theta = one.advance(0.0, 500.0, {{0, share, 500.0}});
        CAPTURE(share);
        CHECK(theta == Approx(warmest * -std::expm1(-rate * 600.0 * (1.0 - share))).margin(0.01));
    }
}

// As thin and conductive as it gets: nothing may blow up, and both faces are one.
TEST_CASE("foil follows its films at once", "[thermal][plate][stress]") {
    One one({1e-5, 400.0, 8960.0, 385.0}, 600.0, 0.0);
    for (const double heat : {900.0, 0.0, 900.0, 900.0}) {
        const double theta = one.advance(heat, heat);
        CHECK(std::isfinite(theta));
    }
    CHECK(one.batch.temperature[0][0] - air_temperature == Approx(900.0 / 24.0).epsilon(1e-6));
    CHECK(one.batch.temperature[0][0] == Approx(one.batch.temperature[1][0]).margin(1e-4));
    CHECK(one.record.worst_closure < 1e-9);
}

// At 250 m/s a metre of plate has a film of 491 W/m²K (plate_film_test), and steel of 1 mm follows
// it in 4 s: q on the front shows as q / 2h on both faces, in steps as long as they may be.
TEST_CASE("sheet steel in a wind of 250 m/s follows its film without a swing",
          "[thermal][plate][stress][by_extreme]") {
    ThermalSurface surface = plate({0.001, 45.0, 7800.0, 500.0});
    surface.convection = BodyFilm{};
    const AirState state{.temperature = 288.15, .pressure = 101325.0, .vapour_pressure = 0.0};
    const AirFilm air = air_film(surface, {}, state, 250.0);
    for (const double seconds : {10.0, 600.0, 3600.0}) {
        CAPTURE(seconds);
        PlateBatch batch;
        // The film that steps are made for is the faces' mean slope (thermal/solve/time_level.hpp).
        const PlateStep step = make_plate_step(column_grid(surface.layers, FixedFlux{0.0}), 288.15,
                                               500.0, 500.0, seconds);
        batch.resize(step.modes(), lanes);
        batch.natural.fill(facet_film(surface.convection, 0.5, {}));
        StepRecord record;
        std::vector<double> before(lanes, 0.0), now(lanes, 0.0);
        begin_plates(step, surface, air, now.data(), batch);
        for (int i = 0; i < 24; ++i) {
            now.assign(lanes, i % 6 < 3 ? 1000.0 : 0.0);
            advance_plates(step, surface, {air, air, before.data(), now.data(), {}}, batch, record);
            before = now;
            for (std::size_t l = 0; l < lanes; ++l) {
                const double theta = batch.temperature[0][l] - 288.15;
                CHECK(theta > -0.02);
                CHECK(theta < 1000.0 / (2.0 * 491.0) + 0.05);
                if (i % 6 == 2) CHECK(theta == Approx(1000.0 / (2.0 * 491.0)).epsilon(0.03));
                if (i % 6 == 5) CHECK(theta == Approx(0.0).margin(0.02));
            }
        }
        CHECK(record.worst_closure < 1e-9);
    }
}
