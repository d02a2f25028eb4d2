#include "thermal/column/column.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "thermal/steppers/layered_step.hpp"

using namespace diurna;

namespace {

constexpr double pi = 3.14159265358979323846;

/// Surface of one lane under given heat, no emission, film h to air of `air` K.
struct Bar {
    MaterialColumn column;
    LayeredBatch batch;
    StepRecord record;
    double film, air;

    Bar(std::vector<Layer> layers, Bottom bottom, double start, double step, GridOptions grid,
        double film_ = 0.0, double air_ = 300.0)
        : film(film_), air(air_) {
        ThermalSurface surface;
        surface.emissivity = 0.0;
        surface.convection = ConstantFilm{film};
        surface.layers = std::move(layers);
        surface.bottom = bottom;
        column = material_column(
            surface, {.step = step, .reference = start, .most_substeps = 1, .grid = grid});
        batch.resize(column.grid.size(), 1);
        batch.temperature[0] = start;
    }
    void step(double heat_1, double heat_2) {
        AirFilm exchange{};
        exchange.neutral = film;
        exchange.air_temperature = air;
        exchange.heat_capacity = 1200.0;
        advance(column, {exchange, exchange}, {&heat_1, &heat_2}, batch, record);
    }
};

constexpr Layer half_space{6.0, 1.0, 2000.0, 1000.0};

/// Worst error of the surface of a half-space under a wave of flux, started on the exact solution.
double wave_error(double step, double first) {
    const double w = 2.0 * pi / 86400.0, effusivity = std::sqrt(2e6), amplitude = 100.0;
    const double skin = std::sqrt(2.0 / (2e6 * w));
    Bar bar({half_space}, FixedFlux{0.0}, 300.0, step,
            {.first = first, .growth = first, .deepest = 1e9});
    const auto exact = [&](double t, double z) {
        return amplitude / (effusivity * std::sqrt(w)) * std::exp(-z / skin) *
               std::cos(w * t - z / skin - pi / 4.0);
    };
    for (std::size_t i = 0; i < bar.column.grid.size(); ++i) {
        bar.batch.state[i * lanes] = exact(0.0, bar.column.grid.depth[i]);
    }
    double worst = 0.0;
    for (int i = 0; i * step < 86400.0; ++i) {
        const double t = i * step;
        bar.step(amplitude * std::cos(w * (t + sdirk_gamma * step)),
                 amplitude * std::cos(w * (t + step)));
        worst = std::max(worst, std::abs(bar.batch.state[0] - exact(t + step, 0.0)));
    }
    return worst;
}

}  // namespace

TEST_CASE("a column is second order in time and in space",
          "[thermal][column][order][by_variation]") {
    const double time_order = std::log2(wave_error(3600.0, 0.005) / wave_error(1800.0, 0.005));
    const double space_order = std::log2(wave_error(60.0, 0.16) / wave_error(60.0, 0.08));
    CAPTURE(time_order, space_order);
    CHECK(time_order > 1.9);
    CHECK(time_order < 2.2);
    CHECK(space_order > 1.9);
    CHECK(space_order < 2.3);
    CHECK(wave_error(600.0, 0.05) < 0.03);
}

TEST_CASE("the default grid carries the daily wave to 0.40 % and 0.42 min",
          "[thermal][column][grid]") {
    // Nodes and links eliminated upward at the daily frequency, against the half-space's
    // admittance, effusivity times the root of iω (Carslaw & Jaeger 2.6): no step of time in it.
    const auto check = [](const GridOptions& options, double swing, double minutes) {
        const ColumnGrid grid = column_grid(std::vector{half_space}, FixedFlux{0.0}, options);
        CAPTURE(options.growth, grid.size());
        const std::complex<double> i_omega(0.0, 2.0 * pi / 86400.0);
        std::complex<double> admittance = i_omega * grid.capacity.back();
        for (std::size_t n = grid.size() - 1; n-- > 0;) {
            admittance =
                i_omega * grid.capacity[n] + 1.0 / (1.0 / grid.conductance[n] + 1.0 / admittance);
        }
        const std::complex<double> answer = std::sqrt(i_omega * 2e6) / admittance;
        CHECK(std::abs(answer) - 1.0 == Approx(swing).margin(1e-4));
        CHECK(-std::arg(answer) / (2.0 * pi) * 1440.0 == Approx(minutes).margin(0.01));
    };
    check({}, -0.0040, 0.416);
    check({.growth = 0.05}, -0.0005, 0.209);
    CHECK(column_grid(std::vector{half_space}, FixedFlux{0.0}).size() <= 24);
    // The second in steps of a minute and nodes to the bottom: all of its error.
    CHECK(wave_error(60.0, GridOptions{}.first) < 0.0015 * 8.2919);
}

TEST_CASE("nodes lie on interfaces and hold all of the layers' heat", "[thermal][column][grid]") {
    const std::vector<Layer> road{
        {0.1, 1.2, 2100.0, 1000.0}, {0.001, 0.03, 30.0, 1400.0}, {0.3, 0.8, 1600.0, 1000.0}};
    const ColumnGrid grid = column_grid(road, Interior{293.0, 8.0});
    CHECK(grid.total_capacity() == Approx(0.1 * 2.1e6 + 0.001 * 42000.0 + 0.3 * 1.6e6));
    for (const double interface : {0.0, 0.1, 0.101, 0.401}) {
        CAPTURE(interface);
        CHECK(std::any_of(grid.depth.begin(), grid.depth.end(),
                          [&](double z) { return std::abs(z - interface) < 1e-12; }));
    }
    const SteadyColumn steady = steady_column(grid);
    CHECK(1.0 / steady.conductance == Approx(0.1 / 1.2 + 0.001 / 0.03 + 0.3 / 0.8 + 1.0 / 8.0));
}

TEST_CASE("two half-spaces in contact share Carslaw and Jaeger's temperature",
          "[thermal][column][a5][by_comparison]") {
    // 340 K (k 1.2, C 2.1e6) on 290 K (k 0.25, C 1.2e6): 327.173815208 K, at once and for long.
    Bar bar({{1.0, 1.2, 2100.0, 1000.0}, {0.8, 0.25, 1200.0, 1000.0}}, FixedFlux{0.0}, 300.0, 60.0,
            {.first = 0.04, .growth = 1e-3, .deepest = 1e9});
    const auto& depth = bar.column.grid.depth;
    std::size_t contact = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
        if (std::abs(depth[i] - 1.0) < 1e-9) contact = i;
        bar.batch.state[i * lanes] = depth[i] < 1.0 ? 40.0 : -10.0;
    }
    // The node in the contact holds half a cell of each side.
    const double upper = 2.1e6 * (depth[contact] - depth[contact - 1]);
    const double lower = 1.2e6 * (depth[contact + 1] - depth[contact]);
    bar.batch.state[contact * lanes] = (40.0 * upper - 10.0 * lower) / (upper + lower);
    bar.batch.temperature[0] = 340.0;
    for (int i = 0; i < 720; ++i) bar.step(0.0, 0.0);
    CHECK(bar.batch.state[contact * lanes] + 300.0 == Approx(327.173815208).margin(0.02));
}

TEST_CASE("a thin plate cools to the air exponentially", "[thermal][column][by_comparison]") {
    // 1 mm of steel under a film of 20: 195 s; SDIRK2 in 10 s steps.
    Bar bar({{0.001, 50.0, 7800.0, 500.0}}, FixedFlux{0.0}, 320.0, 10.0, {}, 20.0, 300.0);
    for (int i = 0; i < 60; ++i) bar.step(0.0, 0.0);
    CHECK(bar.batch.temperature[0] ==
          Approx(300.0 + 20.0 * std::exp(-600.0 / 195.0)).margin(0.003));
}

TEST_CASE("a radiating plate follows its closed form", "[thermal][column][a7][by_comparison]") {
    // reference/thermal/analytic_cases.md, A7: 3900 J/m²K, emissivity 0.9, 320 K into 0 K sky.
    ThermalSurface surface;
    surface.emissivity = 0.9;
    surface.convection = ConstantFilm{0.0};
    surface.layers = {{0.001, 50.0, 7800.0, 500.0}};
    const double step = 30.0;
    const MaterialColumn column = material_column(
        surface, {.step = step, .reference = 300.0, .most_substeps = 1, .grid = {}});
    for (const double sky : {0.0, 250.0}) {
        LayeredBatch batch;
        StepRecord record;
        batch.resize(column.grid.size(), 1);
        for (std::size_t i = 0; i < column.grid.size(); ++i) batch.state[i * lanes] = 20.0;
        batch.temperature[0] = 320.0;
        AirFilm none{};
        none.heat_capacity = 1.0;
        const double heat = 0.9 * 5.670374419e-8 * std::pow(sky, 4);
        const auto expect = [&](double t) {
            if (sky == 0.0)
                return t == 600 ? 264.45027229 : t == 3600 ? 179.86967163 : 88.478156542;
            return t == 600 ? 286.11181476 : t == 3600 ? 252.57076232 : 250.00701587;
        };
        for (int i = 1; i <= int(36000.0 / step); ++i) {
            advance(column, {none, none}, {&heat, &heat}, batch, record);
            const double t = i * step;
            if (t == 600 || t == 3600 || (t == 10800 && sky > 0.0) || (t == 36000 && sky == 0.0)) {
                CAPTURE(sky, t);
                CHECK(batch.temperature[0] == Approx(expect(t)).margin(0.01));
            }
        }
        CHECK(record.worst_closure < 1e-9);  // of the 3 W/m² it radiates at 88 K
    }
}
