#include "materials/atmosphere/path_file.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/radiation/planck.hpp"
#include "tests/support/isothermal.hpp"
#include "tests/support/modtran_files.hpp"
#include "tests/support/tape7_text.hpp"

using namespace diurna;
using Catch::Contains;

namespace {

BandModel hazy() { return {.profile = afgl_profile("MLS"), .aerosol = "rural"}; }
const Band& thermal() {
    static const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    return band;
}

/// A table of an air's paths, through the file that MODTRAN would have written of them.
Atmosphere table_of(const BandModel& air, bool convolved) {
    const BinRange bins = bins_of(thermal().node_um);
    std::string text;
    for (const AskedPath& path : asked_paths({0.4, 0.5, 0.6}, {0.3, 0.45, 0.6, 0.8}, 15.0)) {
        const PathSpectrum spectrum = asked_spectrum(air, path, bins);
        text += convolved ? convolved_run(path, spectrum, bins) : tape7_run(path, spectrum, bins);
    }
    const auto table = read_path_table(file_with(text, convolved ? "table.7sc" : "table.tp7"));
    return Tabulated{table, std::make_shared<const Profile>(air.profile)};
}

/// Radiance of a black body seen through a path.
double seen(const PathSpectrum& path, double kelvins) {
    const Band& band = thermal();
    double sum = 0.0;
    for (std::size_t i = 0; i < band.node_um.size(); ++i) {
        sum += band.weight[i] *
               (path.radiance[i] + path.transmittance[i] * planck(band.node_um[i], kelvins));
    }
    return sum;
}

std::string problem_of(const std::string& text, const std::string& name = "bad.tp7") {
    try {
        read_path_table(file_with(text, name));
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a table of paths is within 0.01 % and 1 mK of the air it was made of",
          "[materials][tabulated]") {
    const BandModel air = hazy();
    const bool convolved = GENERATE(false, true);
    const Atmosphere table = table_of(air, convolved);
    const Band& band = thermal();
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double relative = 0.0, kelvin = 0.0, sky = 0.0;
    for (int i = 0; i < 300; ++i) {
        const double from = 0.4 + 0.2 * unit(random), to = 0.3 + 0.5 * unit(random);
        const double least = std::max(0.05, std::abs(from - to));
        const SightLine line = chord(from, to, least + (15.0 - least) * std::pow(unit(random), 2));
        const double a = seen(path_at_nodes(table, line, band.node_um), 300.0);
        const double b = seen(path_at_nodes(air, line, band.node_um), 300.0);
        relative = std::max(relative, std::abs(a / b - 1.0));
        kelvin = std::max(kelvin, std::abs(a - b) / band_radiance_derivative(band, 300.0));
    }
    for (const double zenith : {0.0, 33.0, 61.0, 77.0, 85.5}) {
        const double a = band_sum_nodes(band, sky_at_nodes(table, 0.47, zenith, band.node_um));
        const double b = band_sum_nodes(band, sky_at_nodes(air, 0.47, zenith, band.node_um));
        sky = std::max(sky, std::abs(a / b - 1.0));
        CHECK(band_sum_nodes(band, solar_at_nodes(table, 0.47, zenith, 1.0, band.node_um)) ==
              Approx(band_sum_nodes(band, solar_at_nodes(air, 0.47, zenith, 1.0, band.node_um)))
                  .epsilon(0.015));
    }
    fmt::print("  {}: 300 random lines worst {:.4f} %, {:.2f} mK; sky {:.4f} %\n",
               convolved ? ".7sc" : "tape7", 100.0 * relative, 1e3 * kelvin, 100.0 * sky);
    CHECK(relative < 1e-4);
    CHECK(kelvin < 1e-3);
    CHECK(sky < 2e-3);  // 14 zenith angles
    CHECK(air_temperature_at(table, 0.5) == air_temperature_at(air, 0.5));
}

TEST_CASE("a table of isothermal air keeps an enclosure black",
          "[materials][tabulated][furnace][by_degenerate]") {
    BandModel air = hazy();
    air.profile = isothermal(air.profile, 300.0);
    const Atmosphere table = table_of(air, GENERATE(false, true));
    // The file prints five digits of radiance.
    for (const double range : {0.7, 2.0, 9.0}) {
        const SightLine line = chord(0.5, 0.6, range);
        CHECK(seen(path_at_nodes(table, line, thermal().node_um), 300.0) ==
              Approx(band_radiance(thermal(), 300.0)).epsilon(5e-5));
    }
}

TEST_CASE("a path shorter than the shortest is thinner in proportion", "[materials][tabulated]") {
    const Atmosphere table = table_of(hazy(), false);
    const std::vector<double> node = {10.0};
    const auto depth = [&](double range) {
        return -std::log(path_at_nodes(table, chord(0.5, 0.5, range), node).transmittance[0]);
    };
    CHECK(depth(0.025) == Approx(0.5 * depth(0.05)).epsilon(1e-3));
}

TEST_CASE("what a table does not span is refused", "[materials][tabulated]") {
    const Atmosphere table = table_of(hazy(), false);
    const std::vector<double> node = {10.0}, other = {4.0};
    const TabulatedPaths& paths = *std::get<Tabulated>(table).paths;
    CHECK(paths.span.least_um <= 8.0);
    CHECK(paths.span.most_um >= 12.0);
    CHECK(paths.span.most_range_km == Approx(15.0));
    CHECK_NOTHROW(table_path(paths, 0.5, 0.5, 5.0, node));
    CHECK_THROWS_WITH(table_path(paths, 0.5, 0.5, 20.0, node), Contains("range_km"));
    CHECK_THROWS_WITH(table_path(paths, 2.0, 0.5, 3.0, node), Contains("from_km"));
    CHECK_THROWS_WITH(table_path(paths, 0.5, 0.0, 3.0, node), Contains("to_km"));
    CHECK_THROWS_WITH(table_path(paths, 0.5, 0.5, 3.0, other), Contains("4 um"));
}

TEST_CASE("a file that is no table of paths is refused", "[materials][tabulated]") {
    const BandModel air = hazy();
    const BinRange bins = bins_of(thermal().node_um);
    const auto run = [&](const AskedPath& path) {
        return tape7_run(path, asked_spectrum(air, path, bins), bins);
    };
    const std::string level = run({0.5, 0.5, 1.0});
    CHECK_THAT(problem_of(""), Contains("empty"));
    CHECK_THAT(problem_of(level), Contains("1 paths to surfaces and 0 to space"));
    CHECK_THAT(problem_of(level + run({0.5, 0.0, 0.0, 95.0, true})), Contains("0 to 90"));
    CHECK_THAT(problem_of(level + run({0.5, 0.0, 0.0, 60.0, true})), Contains("at least 89 deg"));
    CHECK_THAT(problem_of(level + level + run({0.5, 0.0, 0.0, 0.0, true})), Contains("twice"));
    CHECK_THAT(problem_of(level + run({0.6, 0.7, 1.0}) + run({0.5, 0.0, 0.0, 0.0, true})),
               Contains("every H2 for every H1"));
}
