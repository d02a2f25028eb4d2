#include "materials/atmosphere/path_grid.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <random>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "tests/support/modtran_stub.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

namespace {

const PrivateTempFolder private_temp_folder;

BandModel hazy() { return {.profile = afgl_profile("MLS"), .aerosol = "rural"}; }
Band band(double from, double to) { return flat_band("", from, to, bin_edges_um()); }

double seen(const Band& in, const NodeSpectrum& path, double kelvins) {
    double sum = 0.0;
    for (std::size_t i = 0; i < in.node_um.size(); ++i) {
        sum += in.weight[i] *
               (path.radiance[i] + path.transmittance[i] * planck(in.node_um[i], kelvins));
    }
    return sum;
}

/// A chord as renderers cut it.
SightLine chord(double from, double to, double range) {
    SightLine line;
    const double sag = range * range / (2.0 * earth_radius_km), rise = to - from - sag;
    constexpr int cuts = 60;
    for (int i = 0; i < cuts; ++i) {
        const double a = double(i * i) / (cuts * cuts),
                     b = double((i + 1) * (i + 1)) / (cuts * cuts);
        const double m = 0.5 * (a + b);
        line.height_km.push_back(from + m * (rise + m * sag));
        line.length_km.push_back((b - a) * range);
    }
    return line;
}

}  // namespace

TEST_CASE("a table is within its stated error of the direct sum: 0.1 % and 5 mK",
          "[materials][tabulated]") {
    const BandModel air = hazy();
    const std::vector<Band> bands = {band(3, 5), band(8, 12)};
    const TableExtent extent{.least_from_km = 0.4,
                             .most_from_km = 0.6,
                             .least_to_km = 0.3,
                             .most_to_km = 0.8,
                             .least_range_km = 0.05,
                             .most_range_km = 15.0};
    const Tabulated table = tabulate(path_source(air), air.profile, extent, bands);
    const TableError& error = table_error(table);
    fmt::print("  table of {} paths: {:.4f} %, {:.2f} mK at its own probes\n", error.paths,
               100.0 * error.relative, 1e3 * error.kelvin);
    CHECK(error.reached);
    CHECK(error.relative <= 1e-3);
    CHECK(error.kelvin <= 5e-3);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double relative = 0.0, kelvin = 0.0;
    for (int i = 0; i < 300; ++i) {
        const double from = 0.4 + 0.2 * unit(random), to = 0.3 + 0.5 * unit(random);
        const double least = std::max(0.05, std::abs(from - to));
        const double range = least + (15.0 - least) * std::pow(unit(random), 2);
        const SightLine line = chord(from, to, range);
        for (const Band& in : bands) {
            const double a = seen(in, path_at_nodes(table, line, in.node_um), 300.0);
            const double b = seen(in, path_at_nodes(air, line, in.node_um), 300.0);
            relative = std::max(relative, std::abs(a / b - 1.0));
            kelvin = std::max(kelvin, std::abs(a - b) / band_radiance_derivative(in, 300.0));
        }
    }
    fmt::print("  300 random lines: worst {:.4f} %, {:.2f} mK\n", 100.0 * relative, 1e3 * kelvin);
    CHECK(relative <= 1e-3);
    CHECK(kelvin <= 5e-3);
    // Sky and sun through the same variant.
    double sky = 0.0;
    for (const double zenith : {0.0, 33.0, 61.0, 77.0, 85.5}) {
        for (const Band& in : bands) {
            const double a = band_sum_nodes(in, sky_at_nodes(table, 0.47, zenith, in.node_um));
            const double b = band_sum_nodes(in, sky_at_nodes(air, 0.47, zenith, in.node_um));
            sky = std::max(sky, std::abs(a / b - 1.0));
        }
        const Band& in = bands[0];
        CHECK(band_sum_nodes(in, solar_at_nodes(table, 0.47, zenith, 1.0, in.node_um)) ==
              Approx(band_sum_nodes(in, solar_at_nodes(air, 0.47, zenith, 1.0, in.node_um)))
                  .epsilon(3e-3));
    }
    fmt::print("  sky: worst {:.4f} %\n", 100.0 * sky);
    CHECK(sky < 1e-3);
    CHECK(air_temperature_at(table, 0.5) == air_temperature_at(air, 0.5));
    const auto cut = paths_at_nodes(table, chord(0.5, 0.5, 4.0), bands[0].node_um);
    CHECK(cut.back().transmittance ==
          path_at_nodes(table, chord(0.5, 0.5, 4.0), bands[0].node_um).transmittance);
}

TEST_CASE("a table of isothermal air keeps an enclosure black", "[materials][tabulated][furnace]") {
    BandModel air = hazy();
    air.profile = isothermal(air.profile, 300.0);
    const std::vector<Band> bands = {band(8, 12)};
    const Tabulated table =
        tabulate(path_source(air), air.profile, {.least_to_km = 0.0, .most_to_km = 0.5}, bands, {},
                 300.0, 300.0);
    for (const double range : {0.7, 2.0, 9.0}) {
        CHECK(seen(bands[0], path_at_nodes(table, chord(0.0, 0.3, range), bands[0].node_um),
                   300.0) == Approx(band_radiance(bands[0], 300.0)).epsilon(1e-6));
    }
    CHECK(band_sum_nodes(bands[0], sky_at_nodes(table, 0.0, 42.0, bands[0].node_um)) ==
          Approx(band_radiance(bands[0], 300.0)).epsilon(1e-6));
}

TEST_CASE("a tighter tolerance makes a larger table, a limit is told of",
          "[materials][tabulated]") {
    const BandModel air = hazy();
    const std::vector<Band> bands = {band(3, 5)};
    const TableExtent extent{.most_to_km = 0.5};
    const auto paths = [&](const TableTolerance& tolerance) {
        return table_error(tabulate(path_source(air), air.profile, extent, bands, tolerance));
    };
    const TableError coarse = paths({.relative = 0.05, .kelvin = 1.0});
    const TableError fine = paths({.relative = 5e-4, .kelvin = 2e-3});
    CHECK(coarse.paths < fine.paths);
    CHECK(fine.relative < 5e-4);
    const TableError cut = paths({.relative = 1e-9, .kelvin = 1e-9, .most_paths = 200});
    CHECK_FALSE(cut.reached);
    CHECK(cut.relative > 1e-9);
}

TEST_CASE("what a table does not hold is refused", "[materials][tabulated]") {
    const BandModel air = hazy();
    const std::vector<Band> bands = {band(8, 12)};
    const Tabulated table = tabulate(path_source(air), air.profile, {.most_range_km = 5.0}, bands,
                                     {.relative = 0.1, .kelvin = 10.0});
    const std::vector<double> node = {10.0}, other = {4.0};
    CHECK_NOTHROW(table_path(table, 0, 0, 5.0, node));
    CHECK_THROWS_AS(table_path(table, 0, 0, 9.0, node), InputError);
    CHECK_THROWS_AS(table_path(table, 2.0, 0, 3.0, node), InputError);
    CHECK_THROWS_AS(table_path(table, 0, 0, 3.0, other), InputError);
}

TEST_CASE("a table is filled from MODTRAN, here a stub of it", "[materials][tabulated][run]") {
    const auto script = std::filesystem::temp_directory_path() / "diurna_tabulated_stub.sh";
    write_modtran_stub(script);
    const ModtranRunner runner{.executable = script, .data = {}};
    const std::vector<Band> bands = {band(10.0, 10.5)};
    const TableExtent extent{.least_range_km = 0.5, .most_range_km = 8.0};
    const Tabulated table =
        tabulate(path_source(runner, ModtranDeck{}), isothermal(afgl_profile("US76"), 300.0),
                 extent, bands, {.relative = 1e-3, .kelvin = 0.01});
    CHECK(table_error(table).reached);
    const Band& in = bands[0];
    for (const double range : {0.5, 1.7, 6.3}) {
        const NodeSpectrum path = path_at_nodes(table, SightLine{{0.0}, {range}}, in.node_um);
        CHECK(band_mean_nodes(in, path.transmittance) ==
              Approx(std::exp(-0.1 * range)).epsilon(1e-4));
        CHECK(seen(in, path, 300.0) == Approx(band_radiance(in, 300.0)).epsilon(1e-3));
    }
    CHECK(band_mean_nodes(in, table_sky(table, 0.0, 50.0, in.node_um).transmittance) ==
          Approx(std::exp(-0.2)).epsilon(1e-4));
}
