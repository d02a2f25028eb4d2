#include "thermal/steppers/mode_batch.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <span>

#include "materials/base/units.hpp"
#include "materials/matter/library.hpp"
#include "materials/matter/read_library.hpp"
#include "tests/support/passed_over.hpp"
#include "thermal/kernels/surface_kernel.hpp"
#include "thermal/surface/heat_balance.hpp"

using namespace diurna;

namespace {

/// Facets of one material under sun from none to 1100 W/m², stepped away from one temperature near
/// the air's, so that dew and drying, warm and cold ground are all among the lanes.
struct Case {
    ModeStep step;
    ModeBatch batch;
    AirFilm before, air;
    double heat_before[lanes], heat[lanes];

    Case(const ThermalSurface& surface, double wind, double vapour_pressure) {
        const ReducedColumn column = reduce_column(surface.layers, surface.bottom, 290.0);
        step = make_mode_step(column, close_column(column, 20.0), 600.0);
        const LouisForm louis =
            louis_form(surface.roughness_length, surface.heat_roughness_length, 10.0, 2.0);
        AirState state;
        state.temperature = 291.0;
        state.pressure = 97000.0;
        state.vapour_pressure = vapour_pressure;
        before = air_film(surface, louis, state, wind);
        state.temperature = 291.2;
        air = air_film(surface, louis, state, 1.05 * wind);
        batch.resize(step.modes(), lanes);
        batch.natural.fill(facet_film(surface.convection, 1.0, {}));
        for (std::size_t l = 0; l < lanes; ++l) {
            heat_before[l] = surface.emissivity * 300.0 + 35.0 * double(l);
            heat[l] = heat_before[l] * 1.02;
        }
    }
};

}  // namespace

// The kernel says in short loops what heat_balance says in one line. A step's closure, and the
// temperatures of lanes of all kinds, hold against that line, not against the loops themselves.
TEST_CASE("the surfaces of a step in modes are in balance to 1e-9",
          "[thermal][modes][energy][by_trace]") {
    const MaterialLibrary library = default_material_library();
    const double wind = GENERATE(0.3, 3.0, 20.0), vapour = GENERATE(300.0, 2050.0);
    for (std::size_t i = 0; i < library.size(); ++i) {
        const Material& material = library[MaterialId(i)];
        if (material.thermal.back) continue;
        CAPTURE(material.name, wind, vapour);
        const double emissivity = material.thermal.emissivity;
        Case c(material.thermal, wind, vapour);
        begin_modes(c.step, c.before, c.heat_before, emissivity, c.batch);
        StepRecord record;
        for (int n = 0; n < 6; ++n) {
            advance_modes(c.step,
                          {.air_before = c.before,
                           .air = c.air,
                           .heat_before = c.heat_before,
                           .heat = c.heat,
                           .jumps = {}},
                          emissivity, c.batch, record);
            for (std::size_t l = 0; l < lanes; ++l) {
                CAPTURE(n, l);
                const double t = c.batch.temperature[l], theta = t - c.step.reference;
                const HeatBalance balance = heat_balance(c.air, c.batch.natural[l], emissivity,
                                                         {.absorbed_solar = c.heat[l]}, t);
                const double taken = c.batch.drive[l] - c.step.film * theta - c.step.flux_below;
                const double terms = c.heat[l] - balance.longwave_out + std::abs(balance.sensible) +
                                     std::abs(balance.latent);
                REQUIRE(std::abs(balance.sum() - taken) < 1e-9 * terms);
            }
        }
    }
}

TEST_CASE("both widths of vectors step the same day to the last digits", "[thermal][modes]") {
    if (!wide_vectors()) {
        pass_over("this processor has no AVX-512");
        return;
    }
    const MaterialLibrary library = default_material_library();
    for (const char* name : {"grass", "asphalt", "painted_steel"}) {
        CAPTURE(name);
        const ThermalSurface& surface = library[library.find(name)].thermal;
        Case a(surface, 3.0, 2050.0), b(surface, 3.0, 2050.0);
        const auto run = [&](Case& c, const ModeKernel& kernel) {
            begin_modes(c.step, c.before, c.heat_before, surface.emissivity, c.batch);
            for (int n = 0; n < 144; ++n) {
                kernel.advance(c.before, c.air, c.step.coefficients(surface.emissivity),
                               {.dew_point = 290.0,
                                .natural = c.batch.natural.data(),
                                .heat_before = c.heat_before,
                                .heat = c.heat,
                                .state = c.batch.state.data(),
                                .temperature = c.batch.temperature.data(),
                                .drive = c.batch.drive.data(),
                                .slope = c.batch.slope.data()});
            }
        };
        run(a, modes_avx2);
        run(b, modes_avx512);
        for (std::size_t l = 0; l < lanes; ++l) {
            REQUIRE(std::abs(a.batch.temperature[l] - b.batch.temperature[l]) < 1e-9);
        }
    }
}

// Lanes on their way from one height's air to another's are each as if all had that lane's own.
TEST_CASE("lanes at heights of their own step as each alone would", "[thermal][modes][heights]") {
    const MaterialLibrary library = default_material_library();
    for (const char* name : {"grass", "asphalt", "painted_steel"}) {
        CAPTURE(name);
        const ThermalSurface& surface = library[library.find(name)].thermal;
        Case all(surface, 3.0, 2050.0), high(surface, 3.0, 1400.0);
        for (AirFilm* air : {&high.before, &high.air}) {
            air->air_temperature -= 9.0;
            air->neutral *= 0.9;
            air->instability *= 1.03;
            air->heat_capacity *= 0.9;
        }
        alignas(64) double up[lanes];
        for (std::size_t l = 0; l < lanes; ++l) up[l] = double(l) / double(lanes - 1);
        const std::vector<HeatJump> jumps{{.lane = 5, .share = 0.4, .heat = 150.0},
                                          {.lane = 30, .share = 0.7, .heat = -80.0}};
        const auto run = [&](Case& c, const AirOver& before, const AirOver& after) {
            begin_modes(c.step, before, c.heat_before, surface.emissivity, c.batch);
            StepRecord record;
            for (int n = 0; n < 12; ++n) {
                const AirOver& from = n == 0 ? before : after;
                advance_modes(c.step,
                              {.air_before = from,
                               .air = after,
                               .heat_before = n == 0 ? c.heat_before : c.heat,
                               .heat = c.heat,
                               .jumps = n == 4 ? std::span<const HeatJump>(jumps)
                                               : std::span<const HeatJump>()},
                              surface.emissivity, c.batch, record);
            }
        };
        run(all, {all.before, high.before, up}, {all.air, high.air, up});
        for (std::size_t l = 0; l < lanes; ++l) {
            Case one(surface, 3.0, 2050.0);
            const AirFilm before = air_between(one.before, high.before, up[l]);
            const AirFilm after = air_between(one.air, high.air, up[l]);
            run(one, before, after);
            CAPTURE(l);
            REQUIRE(all.batch.temperature[l] == Approx(one.batch.temperature[l]).margin(2e-7));
        }
    }
}
