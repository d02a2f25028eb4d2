#include "materials/modtran.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "materials/atmosphere.hpp"
#include "materials/error.hpp"
#include "materials/files.hpp"
#include "materials/planck.hpp"
#include "materials/units.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/shared_data.hpp"

using namespace diurna;
namespace fs = std::filesystem;
using Catch::Contains;

namespace {

const PrivateTempFolder private_temp_folder;

fs::path scratch(const std::string& name) {
    return fs::temp_directory_path() / ("diurna_modtran_test_" + name);
}

fs::path file_with(const std::string& text, const std::string& name = "tape7") {
    write_whole_file(scratch(name), text);
    return scratch(name);
}

/// A sample, unpacked if need be.
fs::path sample(const fs::path& folder, const std::string& name) {
    if (fs::exists(folder / name)) return folder / name;
    const fs::path plain = scratch(name);
    const std::string command =
        "gzip -dc '" + (folder / (name + ".gz")).string() + "' > '" + plain.string() + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    return plain;
}

/// W cm-2 sr-1 / cm-1.
double planck_per_cm(double wavenumber, double temperature) {
    return planck(1e4 / wavenumber, temperature) / per_um_from_modtran(1.0, wavenumber);
}

const std::string header =
    "T F 6    3    2    1    6    6    6    6    6    6    1    0    0 300.000   0.00\n"
    "    1    1    1    0    0    0  23.00000   0.00000   0.00000   0.00000   0.00000\n"
    " -99.000 -99.000 -99.000\n"
    " -99.00000 -99.00000 -99.00000  1.416445  0.000736 ! H2O & O3 COLUMNS [GM/CM2]\n"
    "   361976 U S STANDARD   \n"
    "   2.00000  10.00000  30.00000   9.23590   0.04147   0.00000    0        0.00000\n"
    "    0    0    1    0\n"
    "  25.00000   0.00000  23.00000  45.00000   0.00000   0.00000   0.00000   0.00000\n"
    "    2050.0    2100.0       1.0       1.0NW              \n"
    "    0   0    0.000  0    0.000  0    1.000\n"
    "    FREQ  TOT_TRANS  PTH_THRML  THRML_SCT  SURF_EMIS   SOL_SCAT  SING_SCAT  GRND_RFLT  "
    "DRCT_RFLT  TOTAL_RAD  REF_SOL  SOL@OBS   DEPTH DIR_EM    TOA_SUN BBODY_T[K]\n";
const std::string row_a =
    " 2050.00 0.88372636 1.5902E-08 5.4204E-10 4.8713E-07 2.0005E-10 1.9724E-10 0.0000E+00 "
    "0.0000E+00 5.0323E-07 8.27E-07 8.13E-07   0.124 1.0000 9.6338E-07    297.246\n";
const std::string row_b =
    " 2051.00 0.74512768 3.7278E-08            4.0936E-07 1.6775E-10 1.6479E-10 0.0000E+00 "
    "0.0000E+00 4.4681E-07 6.94-107 6.78E-07   0.294 1.0000 9.6265E-07    293.827\n";

std::string problem(const std::string& text) {
    try {
        read_tape7(file_with(text));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("numbers as Fortran prints them", "[materials][modtran]") {
    double value = -1.0;
    CHECK((parse_fortran("1.5902E-08", value) && value == 1.5902e-8));
    CHECK((parse_fortran("1.5D+02", value) && value == 150.0));
    CHECK((parse_fortran("1.0000-100", value) && value == 1e-100));
    CHECK((parse_fortran("1.0000-320", value) && value >= 0.0 && value < 1e-300));
    CHECK((parse_fortran("-9999.", value) && value == -9999.0));
    for (const char* bad : {"", "*******", "nan", "inf", "1 2", "1,5", "0x10", "1.5E", "--1"}) {
        CAPTURE(bad);
        CHECK_FALSE(parse_fortran(bad, value));
    }
}

TEST_CASE("blank columns stay in their place", "[materials][modtran]") {
    const auto runs = read_tape7(file_with(header + row_a + row_b + " -9999.\n"));
    REQUIRE(runs.size() == 1);
    const SpectralTable& table = runs[0].table;
    CHECK(table.axis == std::vector<double>{2050.0, 2051.0});
    CHECK(std::isnan(table.column("THRML_SCT")[1]));
    CHECK(table.column("SURF_EMIS")[1] == 4.0936e-7);
    CHECK(table.column("REF_SOL")[1] == 6.94e-107);
    CHECK(table.column("BBODY_T[K]")[1] == 293.827);
    CHECK(runs[0].emission == 2);
    CHECK(runs[0].range_km == Approx(9.2359));
    CHECK(runs[0].visibility_km == 23.0);
    CHECK(runs[0].ground_temperature == 300.0);
    CHECK(runs[0].model_name == "1976 U S STANDARD");
}

TEST_CASE("several runs, DOS line ends, MODTRAN 4's headings", "[materials][modtran]") {
    std::string text = header + row_a + row_b + " -9999.\n";
    std::string old = text;
    const std::size_t heading = old.find("    FREQ");
    const std::size_t heading_end = old.find('\n', heading);
    for (std::size_t i = heading; i < heading_end; ++i) {
        if (old[i] == '_') old[i] = ' ';
    }
    std::string dos;
    for (const char c : text + old) {
        if (c == '\n') dos += '\r';
        dos += c;
    }
    const auto runs = read_tape7(file_with(dos));
    REQUIRE(runs.size() == 2);
    CHECK(runs[0].table.name == runs[1].table.name);
    CHECK(runs[0].table.column("TOTAL_RAD") == runs[1].table.column("TOTAL_RAD"));
}

TEST_CASE("a damaged tape7 is refused with line and column", "[materials][modtran][stress]") {
    const std::string good = header + row_a + row_b + " -9999.\n";
    CHECK(problem(good).empty());
    CHECK_THAT(problem(header + row_a + row_b), Contains(":13: the file ends"));
    CHECK_THAT(problem(header + row_a + row_b.substr(0, 60)), Contains(":13:"));
    CHECK_THAT(problem(header.substr(0, 300)), Contains(":6:"));
    CHECK_THAT(problem(""), Contains("empty"));
    CHECK_THAT(problem("hello\n" + good), Contains(":1:"));
    CHECK_THAT(problem(header + row_a + row_a + " -9999.\n"), Contains("ascend"));
    std::string shifted = row_b;  // one column to the right: the wrong columns
    shifted.insert(0, " ");
    CHECK_THAT(problem(header + row_a + shifted + " -9999.\n"), Contains(":13:"));
    std::string nan = row_b;
    nan.replace(9, 10, "       NaN");
    CHECK_THAT(problem(header + row_a + nan + " -9999.\n"), Contains(":13:9: found 'NaN'"));
    std::string stars = row_b;
    stars.replace(9, 10, "**********");
    CHECK_THAT(problem(header + stars + " -9999.\n"), Contains("***"));
    std::string comma = row_b;
    comma[10] = ',';
    CHECK_THAT(problem(header + comma + " -9999.\n"), Contains("separator"));
    // A transmittance row among radiance rows.
    const std::string mixed = " 2052.00 0.9100 0.9726 0.9679 0.9998 1.0000 1.0000 0.9775 1.0000\n";
    CHECK_THAT(problem(header + row_a + mixed + " -9999.\n"), Contains(":13:"));
    // Cut anywhere within the data it is refused, never read in part.
    bool all = true;
    for (std::size_t size = header.size(); size + 7 < good.size(); size += 3) {
        all = all && !problem(good.substr(0, size)).empty();
    }
    CHECK(all);
}

TEST_CASE("a file of 10 GB is refused unread", "[materials][modtran][stress]") {
    const fs::path huge = scratch("huge");
    { std::ofstream(huge) << "T"; }
    fs::resize_file(huge, 10ull << 30);  // sparse: takes no space
    CHECK_THROWS_AS(read_tape7(huge), InputError);
    CHECK_THROWS_AS(read_7sc(huge), InputError);
    CHECK_THROWS_AS(read_flx(huge), InputError);
    CHECK_THROWS_AS(read_modtran6_json(huge), InputError);
    CHECK_THROWS_AS(read_modtran6_csv(huge), InputError);
    CHECK_THROWS_AS(read_spectral_csv(huge), InputError);
    fs::remove(huge);
}

TEST_CASE("published tape7 files keep MODTRAN's own identities",
          "[materials][modtran][reference]") {
    const auto folder = shared_data("data/atmosphere/tape7/modtran5_pyradi");
    if (!folder) return;
    for (const char* name : {"tape7-01", "tape7-01b", "horizon5kmtropical.fl7"}) {
        for (const Tape7Run& run : read_tape7(sample(*folder, name))) {
            REQUIRE(run.emission == 0);
            const SpectralTable& t = run.table;
            // Line by line the parts are correlated; in the mean over a band they multiply.
            double depth = 0.0;
            for (const auto& [from, to] :
                 {std::pair{650.0, 800.0}, std::pair{833.0, 1250.0}, std::pair{2000.0, 2222.0},
                  std::pair{2439.0, 2857.0}, std::pair{4000.0, 5000.0}, std::pair{5556.0, 6667.0},
                  std::pair{14286.0, 25000.0}}) {
                double totals = 0.0, products = 0.0;
                for (std::size_t i = 0; i < t.axis.size(); ++i) {
                    if (t.axis[i] < from || t.axis[i] > to) continue;
                    double product = 1.0;
                    for (const char* part :
                         {"H2O_TRANS", "UMIX_TRANS", "O3_TRANS", "TRACE_TRANS", "N2_CONT",
                          "H2O_CONT", "MOLEC_SCAT", "AER+CLD_TRANS", "HNO3_TRANS"}) {
                        product *= t.column(part)[i];
                    }
                    totals += t.column("TOT_TRANS")[i];
                    products += product;
                }
                if (totals < 1.0) continue;
                CAPTURE(name, from);
                CHECK(products / totals == Approx(1.0).epsilon(0.0017));
            }
            for (std::size_t i = 0; i < t.axis.size(); ++i) {
                const double total = t.column("TOT_TRANS")[i];
                if (total > 0.01) {
                    depth = std::max(
                        depth, std::abs(t.column("DEPTH")[i] + std::log(total)) - 1e-4 / total);
                }
            }
            CAPTURE(name);
            CHECK(depth < 1e-3);  // of one printed to three
            CHECK(t.column("DEPTH").back() > 0.0);
        }
    }
    int radiance_runs = 0;
    for (const char* name :
         {"tape7-02", "tape7-02b", "tape7-02c", "tape7-03", "tape7-03b", "tape7-05", "tape7-05b",
          "tape7.LWIRSun", "tape7.MWIRSun", "NIRscat.fl7"}) {
        for (const Tape7Run& run : read_tape7(sample(*folder, name))) {
            ++radiance_runs;
            REQUIRE((run.emission == 1 || run.emission == 2));
            const SpectralTable& t = run.table;
            double black = 0.0, sum = 0.0, depth = 0.0, surface = 0.0;
            for (std::size_t i = 0; i < t.axis.size(); ++i) {
                const auto of = [&](const char* column) {
                    const double value = t.column(column)[i];
                    return std::isnan(value) ? 0.0 : value;
                };
                const double total = of("TOTAL_RAD"), kelvins = of("BBODY_T[K]");
                // B(T) magnifies the last printed digit of T by x / T; its c2 was 1.4388.
                const double slack = 5e-4 * 1.4388 * t.axis[i] / (kelvins * kelvins) + 5e-5 +
                                     1e-5 * 1.4388 * t.axis[i] / kelvins;
                black = std::max(black,
                                 std::abs(planck_per_cm(t.axis[i], kelvins) / total - 1.0) - slack);
                const double parts =
                    of("PTH_THRML") + of("SURF_EMIS") + of("SOL_SCAT") + of("GRND_RFLT");
                sum = std::max(sum, std::abs(parts / total - 1.0));
                const double tau = of("TOT_TRANS");
                if (tau > 1e-4) {
                    depth = std::max(depth, std::abs(-std::log(tau) - of("DEPTH")) - 1e-8 / tau);
                }
                CHECK(of("DEPTH") <= 99.990);
                if (of("SURF_EMIS") > 0.0) {
                    const double emitted =
                        tau * of("DIR_EM") * planck_per_cm(t.axis[i], run.ground_temperature);
                    surface = std::max(surface, std::abs(of("SURF_EMIS") / emitted - 1.0));
                }
                CHECK(of("THRML_SCT") <= of("PTH_THRML") * 1.0001);
                CHECK(of("SING_SCAT") <= of("SOL_SCAT") * 1.0001);
                CHECK(of("DRCT_RFLT") <= of("GRND_RFLT") * 1.0001);
            }
            CAPTURE(name);
            CHECK(black < 1.5e-4);
            CHECK(sum < 1.2e-4);
            CHECK(depth < 6e-4);
            CHECK(surface < 2e-4);
        }
    }
    CHECK(radiance_runs >= 10);
    for (const char* name : {"tape7-04", "tape7-sunE"}) {
        for (const Tape7Run& run : read_tape7(sample(*folder, name))) {
            REQUIRE(run.emission == 3);
            double worst = 0.0;
            for (std::size_t i = 0; i < run.table.axis.size(); ++i) {
                const double direct = std::exp(-run.table.column("DEPTH")[i]);
                const double ratio = run.table.column("SOL_TR")[i] / run.table.column("SOLAR")[i];
                if (direct > 1e-3) worst = std::max(worst, std::abs(ratio / direct - 1.0));
                // Half a unit of the last of four digits in each.
                const double rounding = 6e-5 + 5e-4 * direct * run.table.column("DEPTH")[i];
                CHECK(run.table.column("TOT_TRANS")[i] == Approx(direct).margin(rounding));
            }
            CAPTURE(name);
            CHECK(worst < 0.012);  // three digits in each of two numbers
        }
    }
}

TEST_CASE("published tape7 files have the columns and headers that FORMATS.md tells of",
          "[materials][modtran][reference]") {
    const auto folder = shared_data("data/atmosphere/tape7/modtran5_pyradi");
    if (!folder) return;
    // 36 columns of MODTRAN 5.2, 40 of 5.3; the wavenumber is one of them.
    const Tape7Run older = read_tape7(sample(*folder, "tape7-01"))[0];
    const Tape7Run newer = read_tape7(sample(*folder, "tape7-01b"))[0];
    CHECK(older.table.name.size() == 35);
    CHECK(newer.table.name.size() == 39);
    // Level paths echo H2 and ANGLE unused: H1 and RANGE count.
    CHECK(older.path_type == 1);
    CHECK(older.h1_km == 2.0);
    CHECK(older.range_km == 2.0);
    // SURREF runs into the field before it: "   0.0000.30000".
    CHECK(newer.ground_temperature == 0.0);
    CHECK(newer.range_km == 1.0);
    // Without a cloud its transmittance is printed as 0 in 5.2, and is no factor of the total.
    const Tape7Run level = read_tape7(sample(*folder, "horizon5kmtropical.fl7"))[0];
    CHECK(level.range_km == 5.0);
    const std::vector<double>& cloud = level.table.value.at(21);
    CHECK(level.table.name.at(21).find("CLOUD") != std::string::npos);
    CHECK(*std::max_element(cloud.begin(), cloud.end()) == 0.0);
    const std::vector<double>& total = level.table.column("TOT_TRANS");
    CHECK(*std::max_element(total.begin(), total.end()) > 0.5);
    const auto all_blank = [&](const char* name, const char* column) {
        const SpectralTable table = read_tape7(sample(*folder, name))[0].table;
        const std::vector<double>& value = table.column(column);
        return std::all_of(value.begin(), value.end(), [](double v) { return std::isnan(v); });
    };
    for (const char* column :
         {"SOL_SCAT", "SING_SCAT", "DRCT_RFLT", "REF_SOL", "SOL@OBS", "TOA_SUN"}) {
        CAPTURE(column);
        CHECK(all_blank("tape7-02", column));
        CHECK_FALSE(all_blank("tape7-02c", column));
    }
    CHECK(all_blank("tape7-02b", "THRML_SCT"));
    CHECK(all_blank("tape7-02c", "THRML_SCT"));
    CHECK_FALSE(all_blank("tape7-02", "THRML_SCT"));
    // DRCT_RFLT = REF_SOL (1 - DIR_EM) cos(sun) / pi: these grounds are black, and reflect none.
    for (const char* name : {"tape7-03b", "tape7-05b", "tape7.MWIRSun"}) {
        const SpectralTable t = read_tape7(sample(*folder, name))[0].table;
        for (std::size_t i = 0; i < t.axis.size(); ++i) {
            CHECK(t.column("DIR_EM")[i] == 1.0);
            CHECK(t.column("DRCT_RFLT")[i] == 0.0);
            CHECK((i == 0 || t.axis[i] > t.axis[i - 1]));
        }
    }
}

TEST_CASE("the last word of a tape7's first line is what it may be", "[materials][modtran]") {
    for (const char* surface : {"   0.00", "0.30000", " LAMBER", "     -4"}) {
        CAPTURE(surface);
        std::string text = header + row_a + " -9999.\n";
        text.replace(text.find("   0.00\n"), 7, surface);
        const auto runs = read_tape7(file_with(text));
        CHECK(runs.at(0).ground_temperature == 300.0);
        CHECK(runs.at(0).path_type == 3);
    }
}

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

TEST_CASE("the embedded model keeps to MODTRAN 5's published paths",
          "[materials][modtran][atmosphere][reference]") {
    const auto folder = shared_data("data/atmosphere/tape7/modtran5_pyradi");
    if (!folder) return;
    struct Path {
        const char* file;
        double visibility_km;
        bool to_space;
        double from_um, to_um, within;  // of the band's mean transmittance, relative
    };
    // The first is the run the tables were solved from; the others are independent of it.
    for (const Path& p : {Path{"horizon5kmtropical.fl7", 23, false, 3.5, 4.1, 0.03},
                          Path{"horizon5kmtropical.fl7", 23, false, 3.0, 5.0, 0.03},
                          Path{"horizon5kmtropical.fl7", 23, false, 8.0, 12.0, 0.03},
                          Path{"horizon5kmtropical.fl7", 23, false, 8.0, 14.0, 0.03},
                          Path{"tape7.MWIRSun", 23, true, 3.52, 4.1, 0.03},
                          Path{"tape7.LWIRSun", 23, true, 8.3, 11.6, 0.04}}) {
        const FilePath path = path_of(read_tape7(sample(*folder, p.file))[0]);
        const BandModel air{.profile = afgl_profile("TROP"),
                            .aerosol = "rural",
                            .visibility_km = p.visibility_km,
                            .co2_ppm = 380.0};
        const Spectrum reference{path.wavelength_um, path.transmittance};
        double expected = 0.0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            expected += reference.at(p.from_um + (p.to_um - p.from_um) * (i + 0.5) / steps) / steps;
        }
        const Band band = flat_band("", p.from_um, p.to_um, bin_edges_um());
        const SightLine line = p.to_space ? line_of(air, 0.0, 0.0) : SightLine{{0.0}, {5.0}};
        const double found =
            band_mean_nodes(band, path_at_nodes(air, line, band.node_um).transmittance);
        fmt::print("  {:24} {:4.1f}-{:4.1f} um  {:.4f}  MODTRAN 5 {:.4f}  {:+.2f} %\n", p.file,
                   p.from_um, p.to_um, found, expected, 100.0 * (found / expected - 1.0));
        CAPTURE(p.file, p.from_um);
        CHECK(found == Approx(expected).epsilon(p.within));
    }
}
