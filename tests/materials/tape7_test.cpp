#include "materials/modtran/tape7.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "materials/base/error.hpp"
#include "materials/modtran/fortran_text.hpp"
#include "tests/support/modtran_files.hpp"

using namespace diurna;
namespace fs = std::filesystem;
using Catch::Contains;

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
    const Tape7Table& table = runs[0].table;
    CHECK(table.wavenumber == std::vector<double>{2050.0, 2051.0});
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
    fs::remove(huge);
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
