#include "materials/air/radiosonde.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;
namespace fs = std::filesystem;

namespace {

const PrivateTempFolder private_temp_folder;

fs::path file_with(const std::string& text) {
    const fs::path file = fs::temp_directory_path() / "diurna_radiosonde_test.csv";
    write_whole_file(file, text);
    return file;
}

const std::string header = "height_m,pressure_hPa,temperature_C,relative_humidity_percent\n";

}  // namespace

TEST_CASE("a radiosonde's levels are the air", "[materials][profile]") {
    const Profile p = read_radiosonde(
        file_with("# Fort Worth\n" + header + "200,990,25,60\n1500,850,14,50\n5500,500,-15,20\n"),
        "US76");
    const AirSample air = air_at(p, 0.2);
    CHECK(air.pressure_hPa == Approx(990));
    CHECK(air.temperature == Approx(298.15));
    // 60 % of 31.67 hPa (saturation at 25 C, Smithsonian tables).
    CHECK(air.mixing_ratio_ppm[0] == Approx(0.60 * 31.67 / 990 * 1e6).epsilon(3e-3));
    CHECK(air_at(p, 5.5).temperature == Approx(258.15));
    // 5 km higher it is the model alone.
    CHECK(air_at(p, 30).temperature == air_at(afgl_profile("US76"), 30).temperature);
    CHECK(p.height_km.back() == 120.0);
}

TEST_CASE("pressure that is not given follows from the weight of the air", "[materials][profile]") {
    const Profile p =
        read_radiosonde(file_with(header + "0,1013.25,15,0\n1000,,8.5,0\n2000,,2,0\n"));
    // US standard atmosphere: 898.75 and 794.95 hPa.
    CHECK(air_at(p, 1.0).pressure_hPa == Approx(898.75).epsilon(5e-4));
    CHECK(air_at(p, 2.0).pressure_hPa == Approx(794.95).epsilon(5e-4));
}

TEST_CASE("a sounding may run downward and state a dew point", "[materials][profile]") {
    const Profile p = read_radiosonde(file_with(
        "height_km,pressure_hPa,temperature_K,dew_point_C\n2,800,280,-5\n0,1000,290,10\n"));
    CHECK(p.temperature.front() == 290);
    CHECK(p.mixing_ratio_ppm[0].front() == Approx(12.27 / 1000 * 1e6).epsilon(3e-3));
}

TEST_CASE("what is wrong in a sounding is named with its line", "[materials][profile]") {
    const auto problem = [](const std::string& text) -> std::string {
        try {
            read_radiosonde(file_with(text));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    using Catch::Contains;
    CHECK_THAT(problem(header + "0,1000,20,50\n"), Contains("1 levels"));
    // 1013 to 540 hPa is 5 km in the standard atmosphere, not 16 404 (feet), nor with shares of 1.
    const std::string feet = "0,1013.25,15,50\n8202,750,-1,40\n16404,540,-17,30\n";
    CHECK_THAT(problem(header + feet), Contains("height_m") && Contains("heights in feet"));
    CHECK(problem(header + "0,1013.25,15,50\n2500,750,-1,40\n5000,540,-17,30\n").empty());
    CHECK_THAT(problem(header + "0,1013.25,15,.5\n2500,750,-1,.4\n5000,540,-17,.3\n"),
               Contains("shares of 1"));
    CHECK_THAT(problem(header + "0,1000,20,50\n0,990,20,50\n"), Contains(":3:1"));
    CHECK_THAT(problem(header + "0,1000,20,50\n100,1001,20,50\n"), Contains(":3:2"));
    CHECK_THAT(problem(header + "0,1000,200,50\n100,990,20,50\n"), Contains(":2:3"));
    CHECK_THAT(problem(header + "0,1000,nan,50\n100,990,20,50\n"), Contains(":2:3"));
    CHECK_THAT(problem(header + "0,1000,20,150\n100,990,20,50\n"), Contains(":2:4"));
    CHECK_THAT(problem("z,pressure_hPa\n0,1000\n1,900\n"), Contains("height_km"));
}

namespace {

/// As the University of Wyoming's page gives it (type: text list): columns of seven characters,
/// levels below the ground empty, humidity missing aloft. Numbers made here: temperatures of a
/// morning's inversion, heights by the hypsometric equation from 180 m.
const std::string wyoming_list = R"(<HTML>
<TITLE>University of Wyoming - Radiosonde Data</TITLE>
<H2>72327 BNA Nashville Observations at 12Z 15 Jul 2026</H2>
<PRE>
-----------------------------------------------------------------------------
   PRES   HGHT   TEMP   DWPT   RELH   MIXR   DRCT   SKNT   THTA   THTE   THTV
    hPa     m      C      C      %    g/kg    deg   knot     K      K      K 
-----------------------------------------------------------------------------
 1000.0    122                                                               
  994.0    180   18.2   17.4     95  12.68    200     10  300.0  330.0  302.0
  985.0    259   22.6   18.8     79  14.00    200     10  300.0  330.0  302.0
  960.0    483   22.0   17.0     73  12.80    200     10  300.0  330.0  302.0
  925.0    805   20.4   15.4     73  11.98    200     10  300.0  330.0  302.0
  850.0   1531   15.6   11.6     77  10.15    200     10  300.0  330.0  302.0
  700.0   3154    6.8   -3.2     49   4.32    200     10  300.0  330.0  302.0
  500.0   5834   -9.7  -24.7     28   1.04    200     10  300.0  330.0  302.0
  300.0   9577  -36.5  -51.5     20   0.11    200     10  300.0  330.0  302.0
  250.0  10814  -46.1                         260     40
  200.0  12262  -56.9                         260     40
</PRE><H3>Station information and sounding indices</H3><PRE>
                         Station identifier: BNA
                             Station number: 72327
                          Station elevation: 180.0
</PRE>
)";

}  // namespace

TEST_CASE("a text list of the University of Wyoming is read from its page",
          "[materials][profile]") {
    const Profile p = read_radiosonde(file_with(wyoming_list), "MLS");
    CHECK(p.height_km.front() == Approx(0.180));
    CHECK(p.temperature.front() == Approx(291.35));
    CHECK(air_at(p, 0.259).temperature == Approx(295.75));
    CHECK(air_at(p, 3.154).pressure_hPa == Approx(700.0));
    // Mixing ratios stand in the list: g/kg, w = 0.622 e / (p − e).
    for (const auto& [km, g_kg] : {std::pair{0.180, 12.68}, {1.531, 10.15}, {5.834, 1.04}}) {
        const AirSample air = air_at(p, km);
        const double e = air.vapour_pressure_hPa();
        CHECK(622.0 * e / (air.pressure_hPa - e) == Approx(g_kg).epsilon(0.01));
    }
    // Hydrostatic: between levels ln p falls by g Δz / R Tv, here with the mean of both ends' Tv.
    double ln_pressure = std::log(994.0);
    for (std::size_t i = 1; p.height_km[i] < 12.3; ++i) {
        double mean = 0.0;
        for (const std::size_t k : {i - 1, i}) {
            mean += 0.5 * p.temperature[k] * (1.0 + 0.378 * 1e-6 * p.mixing_ratio_ppm[0][k]);
        }
        ln_pressure -= 9.80665 * 1e3 * (p.height_km[i] - p.height_km[i - 1]) / (287.05 * mean);
        CHECK(p.pressure_hPa[i] == Approx(std::exp(ln_pressure)).epsilon(1e-3));
    }
    // Aloft nobody measured vapour: the model's; 5 km above the top all is.
    CHECK(air_at(p, 12.262).mixing_ratio_ppm[0] ==
          Approx(air_at(afgl_profile("MLS"), 12.262).mixing_ratio_ppm[0]));
    CHECK(air_at(p, 20.0).temperature == Approx(air_at(afgl_profile("MLS"), 20.0).temperature));
}

TEST_CASE("the University of Wyoming's CSV has names of its own", "[materials][profile]") {
    const Profile p = read_radiosonde(file_with(
        "time,longitude,latitude,pressure_hPa,geopotential height_m,temperature_C,dew point "
        "temperature_C,ice point temperature_C,relative humidity_%,humidity wrt ice_%,mixing "
        "ratio_g/kg,wind direction_degree,wind speed_m/s\n"
        "2026-07-15 11:00:00,-86.56,36.25,994.0,180,18.2,17.4,,95,,12.68,200,5.0\n"
        "2026-07-15 11:00:01,-86.56,36.25,993.8,182,18.4,17.5,,95,,12.68,200,5.0\n"
        "2026-07-15 11:00:20,-86.56,36.25,985.0,259,22.6,18.8,,79,,14.00,200,5.0\n"
        "2026-07-15 11:10:00,-86.56,36.25,700.0,3154,6.8,-3.2,,49,,4.32,200,5.0\n"));
    CHECK(air_at(p, 0.259).temperature == Approx(295.75));
    // A second's rise is no level of its own.
    CHECK(p.height_km[1] == Approx(0.259));
}

TEST_CASE("two soundings in one list are refused", "[materials][profile]") {
    CHECK_THROWS_WITH(read_radiosonde(file_with(wyoming_list + wyoming_list)),
                      Catch::Contains("2 soundings"));
}

namespace {

/// A list of 25 levels 500 m apart, from 300 m, with the pressures of an isothermal atmosphere.
std::string even_list(std::size_t wrong, double pressure, double height) {
    std::string text =
        "-----------------------------------------------------------------------------\n"
        "   PRES   HGHT   TEMP   DWPT   RELH   MIXR   DRCT   SKNT   THTA   THTE   THTV\n"
        "    hPa     m      C      C      %    g/kg    deg   knot     K      K      K \n"
        "-----------------------------------------------------------------------------\n";
    for (std::size_t i = 0; i < 25; ++i) {
        const double z = 300.0 + 500.0 * double(i), p = 980.0 * std::exp(-500.0 * double(i) / 8e3);
        text +=
            fmt::format("{:7.1f}{:7.0f}{:7.1f}{:7.1f}     40   1.00    180      5\n",
                        i == wrong && pressure > 0.0 ? pressure : p,
                        i == wrong && height > 0.0 ? height : z, 20.0 - double(i), 5.0 - double(i));
    }
    return text;
}

}  // namespace

TEST_CASE("one bad level of a list costs no good one", "[materials][profile]") {
    const Profile good = read_radiosonde(file_with(even_list(99, 0.0, 0.0)));
    CHECK(good.notes.empty());
    const bool high = GENERATE(true, false);
    const Profile bad =
        read_radiosonde(file_with(even_list(4, high ? 0.0 : 400.0, high ? 9000.0 : 0.0)));
    // Levels 500 m apart stay, except for the one.
    for (const double km : {0.8, 1.3, 1.8, 2.8, 3.3, 5.3, 8.8, 12.3}) {
        CAPTURE(high, km);
        CHECK(air_at(bad, km).temperature == Approx(air_at(good, km).temperature).margin(1e-6));
    }
    REQUIRE(bad.notes.size() == 1);
    CHECK_THAT(bad.notes[0],
               Catch::Contains("1 of 25 levels are skipped") && Catch::Contains("line 9"));
}

TEST_CASE("a sounding of the Integrated Global Radiosonde Archive is read",
          "[materials][profile][igra]") {
    // Heights of the first, third and last level; the others are hydrostatic. At 0 °C throughout
    // Δz = 287.05 · 273.15 / 9.80665 · ln(p1 / p2) = 7995.5 m · ln(p1 / p2).
    const std::string first =
        "#USM00072327 2018 07 15 00 2318    5 ncdc-gts ncdc-gts  362500  -865600\n"
        "21 -9999 100000   180B    0B  500 -9999   180    30 \n"
        "20 -9999  95000 -9999     0B-9999   100   180    30 \n"
        "10 -9999  90000  1022B    0B  400 -9999   180    30 \n"
        "30 -9999 -9999   1500 -9999 -9999 -9999   180    30 \n"
        "20 -9999  85000 -9999     0B  300 -9999   180    30 \n";
    const Profile p = read_radiosonde(file_with(first));
    CHECK(p.height_km[0] == Approx(0.180));
    CHECK(p.pressure_hPa[0] == Approx(1000.0));
    CHECK(p.temperature[0] == Approx(273.15));
    CHECK(p.height_km[1] == Approx(0.180 + 7.9955 * std::log(100.0 / 95.0)).epsilon(1e-3));
    CHECK(p.height_km[3] == Approx(1.022 + 7.9955 * std::log(90.0 / 85.0)).epsilon(1e-4));
    // Half saturated at 0 °C: 3.06 hPa; 10 K below: e(-10 °C) = 2.87 hPa (WMO-No. 8, water).
    CHECK(sample_of(p, 0).vapour_pressure_hPa() == Approx(3.06).epsilon(0.01));
    CHECK(sample_of(p, 1).vapour_pressure_hPa() == Approx(2.87).epsilon(0.01));
    std::string second = first;
    second.replace(second.find("07 15 00"), 8, "07 15 12");
    CHECK_THROWS_WITH(
        read_radiosonde(file_with(first + second)),
        Catch::Contains("has 2 soundings") && Catch::Contains("sounding_time = \"2018-07-15T12\""));
    const auto both = file_with(first + second);
    CHECK(read_radiosonde(both, "US76", "2018-07-15T12").height_km[0] == Approx(0.180));
    CHECK_THROWS_WITH(read_radiosonde(both, "US76", "2018-07-16T00"),
                      Catch::Contains("no sounding"));
}
