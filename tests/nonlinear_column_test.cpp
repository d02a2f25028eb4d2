#include "thermal/nonlinear_column.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>

#include "materials/soil.hpp"
#include "materials/units.hpp"
#include "shared_data.hpp"
#include "thermal/column_tool.hpp"

using namespace diurna;

namespace {

const Instant start_instant = parse_instant("2020-06-01T00:00:00Z");

/// A facet under constant air and sun, started uniform.
ColumnJob constant_job(std::vector<Layer> layers, double absorbed, double emissivity, double film,
                       double air, double initial, double span, double step) {
    ColumnJob job;
    job.surface.albedo = 0.0;
    job.surface.emissivity = emissivity;
    job.surface.convection = ConstantFilm{film};
    job.surface.layers = std::move(layers);
    job.start = start_instant;
    job.end = later(start_instant, span);
    job.spin_up = SpinUp::none;
    job.initial_temperature = initial;
    job.step = step;
    Forcing forcing;
    forcing.air.temperature = air;
    forcing.shortwave_down = absorbed;
    forcing.longwave_down = 0.0;
    job.weather = constant_weather(forcing);
    job.weather.instant[0] = start_instant;
    return job;
}

/// Reads to the front: the depth that the latent heat given up stands for.
double front(const NonlinearColumn& column, const std::vector<double>& u, double whole,
             double latent) {
    return (whole - column.molten(u)) / latent;
}

}  // namespace

TEST_CASE("a half-space that radiates follows Volterra's equation at steps of 1 s to 1 h",
          "[thermal][nonlinear][a10]") {
    // reference/thermal/analytic_cases.md, A10. Thermal effusivity alone matters: k C = 2e6, 3025.
    struct Case {
        double initial, flux, emissivity, kc;
        std::vector<std::pair<double, double>> temperature;
    };
    const Case cool{300.0,
                    0.0,
                    1.0,
                    2e6,
                    {{60, 297.24270688},
                     {600, 291.77910574},
                     {3600, 281.96186568},
                     {21600, 264.2939807},
                     {86400, 244.8719008}}};
    const Case warm{290.0,
                    750.0,
                    0.95,
                    2e6,
                    {{60, 292.22306254},
                     {600, 296.65228186},
                     {3600, 304.5128263},
                     {21600, 317.2655035},
                     {86400, 327.6878541}}};
    const Case shock{
        100.0,
        1200.0,
        0.95,
        3025.0,
        {{60, 262.696156}, {600, 352.699094}, {3600, 373.764205}, {36000, 382.504688}}};
    for (const Case& c : {cool, warm, shock}) {
        const bool lunar = c.kc < 1e4;
        const Layer deep =
            lunar ? Layer{1.0, 3025.0 / 1.2e6, 1500.0, 800.0} : Layer{5.0, 1.0, 2000.0, 1000.0};
        const double equilibrium = std::pow(c.flux / (c.emissivity * stefan_boltzmann), 0.25);
        const double low = std::min(c.initial, equilibrium),
                     high = std::max(c.initial, equilibrium);
        for (const double step : {1.0, 60.0, 600.0, 3600.0}) {
            const double span = step < 10.0 ? 600.0 : 86400.0;
            ColumnJob job =
                constant_job({deep}, c.flux, c.emissivity, 0.0, 300.0, c.initial, span, step);
            job.longest_step = step;
            const ColumnResult result = run_column(job);
            double beyond = 0.0, worst = 0.0;
            for (const ColumnRow& row : result.row) {
                beyond = std::max(
                    {beyond, row.surface_temperature - high, low - row.surface_temperature});
            }
            for (const auto& [t, kelvin] : c.temperature) {
                if (t > span || std::fmod(t, step) != 0.0) continue;
                const double found = result.row[std::size_t(t / step)].surface_temperature;
                worst = std::max(worst, std::abs(found - kelvin));
            }
            CAPTURE(c.initial, c.flux, step, result.steps, worst);
            CHECK(worst < 0.05);
            CHECK(beyond <= 1e-9);
            CHECK(result.limited == 0);
            CHECK(result.worst_energy_closure < 1e-10);
        }
    }
}

TEST_CASE("water freezes downward as Neumann's solution says", "[thermal][nonlinear][a6]") {
    // A6: water at +5 °C, surface held at −10 °C; front 2 λ √(a t).
    constexpr double latent = 3.06e8;
    for (const double cell : {0.002, 0.001}) {
        std::vector<Layer> layers;
        Layer water{cell, 0.57, 1000.0, 4190.0};
        // Ice at the water's density: 1.93e6 J/m³K, and 3.06e8 J/m³ of latent heat.
        water.law = Freezing{
            .water = latent / 3.337e5, .frozen_conductivity = 2.22, .frozen_heat_capacity = 1930.0};
        for (int i = 0; i < int(std::lround(0.6 / cell)); ++i) layers.push_back(water);
        const NonlinearColumn column(layers, FixedFlux{0.0}, 273.15,
                                     {.first = 10.0, .growth = 0.1, .deepest = 1e9});
        std::vector<double> u(column.size(), 6.0);  // melted, and 5 K above
        const double whole = column.molten(u);
        const Boundary held = [](double t) { return BoundaryFlux{1e5 * (263.15 - t), -1e5}; };
        double time = 0.0, through = 0.0, worst = 0.0;
        const double before = column.total_heat(u);
        while (time < 86400.0 - 1e-6) {
            const double step = std::min(time < 600.0 ? 5.0 : 60.0, 86400.0 - time);
            const auto taken = column.advance(step, false, {&held, &held}, {nullptr, nullptr}, u);
            REQUIRE(taken.solved);
            through += taken.heat_in;
            time += step;
            if (std::abs(time - 3600.0) < 1e-6) {
                worst = std::abs(front(column, u, whole, latent) / 0.0213117866 - 1.0);
            }
        }
        const double day = std::abs(front(column, u, whole, latent) / 0.104406005 - 1.0);
        CAPTURE(cell, worst, day);
        CHECK(worst < 0.01);
        CHECK(day < 0.002);
        CHECK(column.total_heat(u) - before == Approx(through).epsilon(1e-10));
    }
}

TEST_CASE("the moon's equator follows the converged curve B1", "[thermal][nonlinear][b1]") {
    const auto file = shared_data("reference/thermal/b1_lunar_equator_240.txt");
    if (!file) return;
    std::ifstream in(*file);
    std::vector<double> reference;
    for (double t; in >> t;) reference.push_back(t);
    REQUIRE(reference.size() == 240);
    constexpr double period = 2.55024e6, geothermal = 0.018, sigma = 5.67e-8;
    const NonlinearColumn column(lunar_regolith(0.9), FixedFlux{geothermal}, 250.0,
                                 {.period = period, .first = 0.1, .growth = 0.1, .deepest = 1e9});
    const double step = period / 240.0;
    const auto absorbed = [&](double t) {
        const double angle = 2.0 * std::numbers::pi * t / period;
        const double cosine = std::max(0.0, std::cos(angle));
        const double incidence = degrees(std::acos(cosine));
        const double albedo =
            0.12 + 0.06 * std::pow(incidence / 45.0, 3) + 0.25 * std::pow(incidence / 90.0, 8);
        return cosine > 0.0 ? 1361.0 * cosine * (1.0 - albedo) : 0.0;
    };
    std::vector<double> u(column.size());
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = column.state_of(i, 250.0);
    const auto n = static_cast<Eigen::Index>(u.size());
    std::vector<double> found;
    for (int pass = 0; pass < 8; ++pass) {
        const std::vector<double> begin = u;
        Eigen::MatrixXd map = Eigen::MatrixXd::Identity(n, n);
        found.clear();
        for (int i = 0; i < 240; ++i) {
            std::array<Boundary, 2> top;
            for (std::size_t k = 0; k < 2; ++k) {
                const double heat = absorbed((i + (k == 0 ? sdirk_gamma : 1.0)) * step);
                top[k] = [heat](double t) {
                    const double cube = 0.95 * sigma * t * t * t;
                    return BoundaryFlux{heat - cube * t, -4.0 * cube};
                };
            }
            REQUIRE(column.advance(step, false, {&top[0], &top[1]}, {nullptr, nullptr}, u, &map)
                        .solved);
            found.push_back(column.temperature(0, u[0]));
        }
        Eigen::VectorXd change(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            change[i] = u[std::size_t(i)] - begin[std::size_t(i)];
        }
        if (change.cwiseAbs().maxCoeff() < 1e-6) break;
        REQUIRE(pass < 7);
        const Eigen::VectorXd move =
            (Eigen::MatrixXd::Identity(n, n) - map).fullPivLu().solve(change);
        for (Eigen::Index i = 0; i < n; ++i) u[std::size_t(i)] = begin[std::size_t(i)] + move[i];
    }
    // The file's rows may stand for the beginning or the end of a step.
    double best_rms = 1e9, best_worst = 0.0;
    for (const int shift : {0, 1}) {
        double sum = 0.0, worst = 0.0;
        for (int i = 0; i < 240; ++i) {
            const double e =
                found[std::size_t((i + 239 * shift) % 240)] - reference[std::size_t(i)];
            sum += e * e;
            worst = std::max(worst, std::abs(e));
        }
        if (std::sqrt(sum / 240.0) < best_rms) {
            best_rms = std::sqrt(sum / 240.0);
            best_worst = worst;
        }
    }
    CAPTURE(column.size());
    WARN("B1: rms " << best_rms << " K, max " << best_worst << " K, nodes " << column.size());
    CHECK(best_rms < 0.2);
    CHECK(best_worst < 1.5);
}

TEST_CASE("snow stays at melting until its meltwater has run off", "[thermal][nonlinear][snow]") {
    Layer snow{0.5, 0.2, 300.0, 2090.0};
    snow.law = Melting{.held = 0.0};
    ColumnJob job = constant_job({snow}, 400.0, 0.0, 10.0, 273.15, 273.15, 86400.0, 3600.0);
    const ColumnResult result = run_column(job);
    double melted = 0.0;
    for (const ColumnRow& row : result.row) {
        CHECK(row.surface_temperature <= 273.15 + 1e-9);
        melted += row.melt * 3600.0;
    }
    // The pack starts at melting: nothing but melting can take 400 W/m².
    CHECK(melted == Approx(400.0 * 86400.0).epsilon(1e-6));
    CHECK(result.has_melt);
}
