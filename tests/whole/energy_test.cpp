#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "materials/matter/library.hpp"
#include "materials/matter/read_library.hpp"
#include "thermal/kernels/surface_kernel.hpp"
#include "thermal/steppers/layered_batch.hpp"
#include "thermal/steppers/layered_step.hpp"
#include "thermal/surface/heat_balance.hpp"

using namespace diurna;

namespace {

double stored(const ColumnGrid& grid, const std::vector<double>& state) {
    double sum = 0.0;
    for (std::size_t i = 0; i < grid.size(); ++i) sum += grid.capacity[i] * state[i * lanes];
    return sum;
}

/// Heat into the column [W m⁻²], every term by name: the surface's and what comes from below.
double heat_in(const MaterialColumn& column, const AirFilm& air, NaturalFilm natural, double heat,
               double surface, double bottom) {
    const ColumnGrid& grid = column.grid;
    return heat_balance(air, natural, column.surface.emissivity, {.absorbed_solar = heat}, surface)
               .sum() +
           grid.below_flux +
           grid.conductance.back() * (grid.below_temperature - column.reference - bottom);
}

/// The step's first stage alone, from the column's and the balance's own functions.
double first_stage(const MaterialColumn& column, const AirFilm& air, double heat,
                   LayeredBatch batch) {
    const std::size_t n = column.grid.size();
    std::vector<double> offset(n * lanes);
    double a, flux, slope;
    eliminate(column.grid, column.stage, 1, batch.state.data(), offset.data(), &a);
    double surface = batch.temperature[0];
    solve_surface(air, {.count = 1,
                        .heat = &heat,
                        .natural = batch.natural.data(),
                        .a = &a,
                        .b = column.stage.b,
                        .reference = column.reference,
                        .emissivity = column.surface.emissivity,
                        .temperature = &surface,
                        .flux = &flux,
                        .slope = &slope});
    double theta = surface - column.reference;
    for (std::size_t i = 1; i < n; ++i) theta = column.stage.follow[i] * theta + offset[i * lanes];
    return heat_in(column, air, batch.natural[0], heat, surface, theta);
}

}  // namespace

TEST_CASE("heat in is heat stored, at each step, for every library material",
          "[thermal][energy][by_trace]") {
    const MaterialLibrary library = default_material_library();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double step = GENERATE(1.0, 60.0, 600.0, 10800.0);
    for (const std::string& name : library.names()) {
        const MaterialColumn column =
            material_column(library[library.find(name)].thermal, {.step = step, .grid = {}});
        if (column.surface.back) continue;  // two-sided: tests/thermal/point_job_test.cpp
        LayeredBatch batch;
        batch.resize(column.grid.size(), 1);
        batch.temperature[0] = column.reference;
        batch.natural[0] = facet_film(column.surface.convection, unit(random), {});
        StepRecord record;
        double worst = 0.0;
        for (int i = 0; i < 40; ++i) {
            const AirState air{.temperature = 270.0 + 40.0 * unit(random),
                               .pressure = 95000.0,
                               .vapour_pressure = 2000.0 * unit(random)};
            const AirFilm film = air_film(column.surface, column.louis, air, 8.0 * unit(random));
            const double heat = 200.0 + 900.0 * unit(random);
            const double before = stored(column.grid, batch.state);
            const double first = first_stage(column, film, heat, batch);
            advance(column, {film, film}, {&heat, &heat}, batch, record);
            const double last = heat_in(column, film, batch.natural[0], heat, batch.temperature[0],
                                        batch.state[(column.grid.size() - 1) * lanes]);
            const double gained = stored(column.grid, batch.state) - before;
            const double length = column.stage.tau / sdirk_gamma;
            const double came = length * ((1.0 - sdirk_gamma) * first + sdirk_gamma * last);
            worst = std::max(worst, std::abs(gained - came) / (length * (heat + 400.0)));
        }
        CAPTURE(name, step);
        CHECK(worst < 1e-8);
        CHECK(record.worst_closure < 1e-8);
    }
}
