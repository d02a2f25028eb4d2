#include "materials/modtran/modtran.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/support/modtran_files.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;
using Catch::Contains;

TEST_CASE("convolved tables over nanometres, fluxes in descending order", "[materials][modtran]") {
    const auto tables = read_7sc(
        file_with("  WAVLEN (NM)  TRANS  TOTAL RAD\n"
                  "      3500.00 0.5000 1.0000E-07\n      3501.00 0.6000 1.0000E-07\n -9999.\n",
                  "7sc"));
    REQUIRE(tables.size() == 1);
    CHECK(tables[0].unit == SpectralUnit::nm);
    CHECK(tables[0].column("TRANS")[1] == 0.6);
    const FluxTable flux =
        read_flx(file_with(" SPECTRAL VERTICAL FLUX TABLE (W CM-2 / MICRON)\n"
                           " --------------------------------------------\n"
                           "   1 LAYER BOUNDARIES (  4 TABLE COLUMNS)\n"
                           " TRIANGULAR SLIT FULL-WIDTH-AT-HALF-MAXIMUM:    2.00 MICRONS.\n"
                           " ALTITUDES:        0.00000 KM\n"
                           "            UP      DOWN    DIRECT\n"
                           " ----------------------------------------------------\n"
                           "  11.0  1.0E-05  2.0E-06  3.0E-07\n"
                           "  10.0  1.1E-05  2.5E-06  3.1E-07\n"
                           " ======\n W CM-2: 1 2 3\n",
                           "flx"));
    CHECK(flux.unit == SpectralUnit::um);
    CHECK(flux.axis == std::vector<double>{11.0, 10.0});
    CHECK(flux.down[0] == std::vector<double>{2e-6, 2.5e-6});
}

TEST_CASE("LOWTRAN7's tapes read by their own columns", "[materials][modtran][reference]") {
    const auto folder = shared_data("data/atmosphere/tape7/lowtran7");
    if (!folder) return;
    for (int emission = 0; emission <= 3; ++emission) {
        const auto runs = read_tape7(*folder / fmt::format("iemsct{}.TAPE7", emission));
        REQUIRE(runs.size() == 1);
        const Tape7Run& run = runs[0];
        CHECK(run.lowtran);
        CHECK(run.emission == emission);
        CHECK(run.model_name == "1976 U S STANDARD");
        CHECK(run.table.axis.front() == 2400.0);
        CHECK(run.table.axis.back() == 2600.0);
        CHECK(run.table.axis.size() == 41);
        for (std::size_t i = 0; i < run.table.axis.size(); ++i) {
            CHECK(std::exp(-run.table.column("DEPTH")[i]) ==
                  Approx(run.table.column("TOT_TRANS")[i]).margin(1e-3));
            if (emission == 2) {
                CHECK(run.table.column("PTH_THRML")[i] + run.table.column("SOL_SCAT")[i] +
                          run.table.column("GRND_RFLT")[i] ==
                      Approx(run.table.column("TOTAL_RAD")[i]).epsilon(0.01));
            }
        }
    }
}

TEST_CASE("a convolved tape7 is cut where its headings end", "[materials][modtran]") {
    const std::string head = header.substr(0, header.find("    FREQ"));
    const auto tables = read_7sc(file_with(
        head + "  WAVLEN(MCRN)  TRANS   PTH THRML   SURF EMIS   SOL SCAT   GRND RFLT    TOTAL RAD\n"
               "       3.50000 0.8000  1.0000E-05  2.0000E-05                          3.0000E-05\n"
               "       3.51000 0.8100  1.1000E-05  2.0000E-05                          3.1000E-05\n"
               " -9999.\n",
        "7sc"));
    REQUIRE(tables.size() == 1);
    CHECK(tables[0].unit == SpectralUnit::um);
    CHECK(tables[0].axis == std::vector<double>{3.5, 3.51});
    CHECK(tables[0].name ==
          std::vector<std::string>{"TRANS", "PTH_THRML", "SURF_EMIS", "TOTAL_RAD"});
    CHECK(tables[0].column("TOTAL_RAD")[1] == 3.1e-5);
    const std::string good =
        "     FREQ  TRANS  TOTAL RAD\n  2000.00 0.5000 1.0000E-07\n  2001.00 0.5000 1.0000E-07\n";
    CHECK(read_7sc(file_with(good + " -9999.\n", "7sc"))[0].axis.size() == 2);
    CHECK_THROWS_WITH(read_7sc(file_with(good, "7sc")), Contains("cut off"));
    CHECK_THROWS_WITH(read_7sc(file_with(good + "  2002.00  0.5000 1.0000E-07\n -9999.\n", "7sc")),
                      Contains(":4:"));
}

TEST_CASE("fluxes at levels", "[materials][modtran]") {
    const std::string text =
        " SPECTRAL VERTICAL FLUX TABLE (W CM-2 / CM-1)\n"
        " --------------------------------------------\n"
        "   2 LEVELS (  7 TABLE COLUMNS)\n"
        " TRIANGULAR SLIT FULL-WIDTH-AT-HALF-MAXIMUM:    2.00 CM-1.\n"
        " ALTITUDES:        0.00000 KM             1.00000 KM\n"
        "            UP      DOWN    DIRECT\n"
        " ----------------------------------------------------\n"
        "  900.00  1.0E-05  2.0E-06  3.0E-07\n          1.1E-05  2.1E-06  3.1E-07\n"
        "  901.00  1.0E-05  2.5E-06  3.0E-07\n          1.1E-05  2.1E-06  3.1E-07\n";
    const FluxTable flux = read_flx(file_with(text + " ======\n W CM-2: 1 2 3\n", "flx"));
    CHECK(flux.altitude_km == std::vector<double>{0.0, 1.0});
    CHECK(flux.axis == std::vector<double>{900.0, 901.0});
    CHECK(flux.down[0] == std::vector<double>{2e-6, 2.5e-6});
    CHECK(flux.up[1][1] == 1.1e-5);
    CHECK(flux.direct[1][0] == 3.1e-7);
    CHECK_THROWS_WITH(read_flx(file_with(text, "flx")), Contains("cut off"));
    CHECK_THROWS_WITH(read_flx(file_with(text + " 902.0 1 2\n ======\n", "flx")),
                      Contains("cut off"));
    CHECK_THROWS_WITH(read_flx(file_with(text + " 902.0 x\n ======\n", "flx")), Contains(":12:"));
}

TEST_CASE("MODTRAN 6's JSON and CSV", "[materials][modtran]") {
    const auto tables = read_modtran6_json(file_with(
        R"({"MODTRAN":[{"MODTRANINPUT":{"NAME":"a"},"MODTRANOUTPUT":{"SPECTRA":{"RADIANCE":
        {"FREQ":[1,2],"TOTAL_RAD":[3,4]}}}}]})",
        "json"));
    REQUIRE(tables.size() == 1);
    CHECK(tables[0].name == "a");
    CHECK(tables[0].kind == "RADIANCE");
    CHECK(tables[0].table.column("TOTAL_RAD")[1] == 4.0);
    CHECK_THROWS_WITH(read_modtran6_json(file_with("{\"MODTRAN\":[", "json")), Contains("byte"));
    CHECK_THROWS_WITH(
        read_modtran6_json(file_with(
            R"({"MODTRAN":[{"MODTRANOUTPUT":{"SPECTRA":{"R":{"FREQ":[1,2],"X":[3]}}}}]})", "json")),
        Contains("expected 2"));
    CHECK_THROWS_WITH(
        read_modtran6_json(file_with(
            R"({"MODTRAN":[{"MODTRANOUTPUT":{"SPECTRA":{"R":{"FREQ":[1],"X":["a"]}}}}]})", "json")),
        Contains("number"));
    const std::string csv =
        "{\ncase index, 0\na\nb\nc\nFreq,combin,path\ncm-1,trans,multiple scat\n"
        "2000,0.5,1E-7\n2001,0.6,1E-7\n";
    const auto cases = read_modtran6_csv(file_with(csv + "}\n", "csv"));
    REQUIRE(cases.size() == 1);
    CHECK(cases[0].name == std::vector<std::string>{"combin_trans", "path_multiple_scat"});
    CHECK(cases[0].column("combin_trans")[1] == 0.6);
    CHECK_THROWS_WITH(read_modtran6_csv(file_with(csv, "csv")), Contains("cut off"));
    CHECK_THROWS_WITH(read_modtran6_csv(file_with(csv + "2002,0,6,1E-7\n}\n", "csv")),
                      Contains(":10"));
}

TEST_CASE("plain tables of any spectral variable", "[materials][modtran]") {
    const auto table = read_spectral_csv(
        file_with("# a\nwavelength_nm,transmittance\n400,0.5\n500,0.6\n", "plain.csv"));
    CHECK(table.unit == SpectralUnit::nm);
    CHECK(table.column("transmittance")[1] == 0.6);
    CHECK_THROWS_WITH(
        read_spectral_csv(file_with("wavelength_nm,t\n400,0.5\n400,0.6\n", "plain.csv")),
        Contains(":3:1"));
    CHECK_THROWS_WITH(
        read_spectral_csv(file_with("wavelength_nm,t\n400,0,5\n500,0,6\n", "plain.csv")),
        Contains(":2"));
    // Decimal commas between semicolons, and in quotes.
    CHECK_THROWS_WITH(
        read_spectral_csv(file_with("wavelength_nm;t\n400,0;0,5\n500,0;0,6\n", "plain.csv")),
        Contains("plain.csv:"));
    CHECK_THROWS_WITH(read_spectral_csv(file_with("wavelength_nm,t\n400,\"0,5\"\n", "plain.csv")),
                      Contains(":2:"));
    CHECK_THROWS_WITH(read_spectral_csv(file_with("wavelength_nm,t\n400,nan\n", "plain.csv")),
                      Contains(":2:"));
}
