#include "materials/modtran/tape7.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/support/modtran_files.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;
using Catch::Contains;

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
        CHECK(run.table.wavenumber.front() == 2400.0);
        CHECK(run.table.wavenumber.back() == 2600.0);
        CHECK(run.table.wavenumber.size() == 41);
        for (std::size_t i = 0; i < run.table.wavenumber.size(); ++i) {
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
    const auto runs = read_tape7(file_with(
        head + "  WAVLEN(MCRN)  TRANS   PTH THRML   SURF EMIS   SOL SCAT   GRND RFLT    TOTAL RAD\n"
               "       4.00000 0.8000  1.0000E-05  2.0000E-05                          3.0000E-05\n"
               "       5.00000 0.8100  1.1000E-05  2.0000E-05                          3.1000E-05\n"
               " -9999.\n",
        "convolved.7sc"));
    REQUIRE(runs.size() == 1);
    CHECK(runs[0].range_km == Approx(9.2359));
    const Tape7Table& table = runs[0].table;
    CHECK(table.name == std::vector<std::string>{"TOT_TRANS", "PTH_THRML", "SURF_EMIS", "SOL_SCAT",
                                                 "GRND_RFLT", "TOTAL_RAD"});
    CHECK(table.wavenumber == std::vector<double>{2000.0, 2500.0});
    CHECK(table.column("TOT_TRANS") == std::vector<double>{0.81, 0.8});
    // 5 µm: dλ = 10⁴ dν / ν² = 0.0025 µm per cm⁻¹.
    CHECK(table.column("TOTAL_RAD")[0] == Approx(3.1e-5 * 0.0025).epsilon(1e-12));
    CHECK(std::isnan(table.column("SOL_SCAT")[0]));
    // In this program's units that is W cm⁻² made W m⁻².
    const Tape7Spectra spectra = spectra_of(runs[0]);
    CHECK(spectra.wavelength_um[0] == Approx(4.0));
    CHECK(spectra.thermal[0] == Approx(1.0e-5 * 1e4).epsilon(1e-12));
}

TEST_CASE("a convolved tape7 over wavenumbers keeps its radiances", "[materials][modtran]") {
    const std::string head = header.substr(0, header.find("    FREQ"));
    const std::string good =
        head +
        "     FREQ  TRANS  PTH THRML\n  2000.00 0.5000 1.0000E-07\n  2001.00 0.5000 1.0000E-07\n";
    const auto read = [](const std::string& text) { return read_tape7(file_with(text, "x.scn")); };
    CHECK(read(good + " -9999.\n")[0].table.column("PTH_THRML")[1] == 1e-7);
    CHECK_THROWS_WITH(read(good), Contains("truncated"));
    CHECK_THROWS_WITH(read(good + "  2002.00  0.5000 1.0000E-07\n -9999.\n"), Contains(":14:"));
    CHECK_THROWS_WITH(read(good + good.substr(head.size())), Contains(":14:"));
    std::string nm = good;
    nm.replace(head.size(), 9, "WAVLEN(NM)");
    CHECK_THROWS_WITH(read(nm), Contains("cm-1 or µm"));
}
