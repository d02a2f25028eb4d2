#include "materials/air/radiosonde.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

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
        file_with("# Fort Worth\n" + header + "200,990,25,60\n1500,850,14,50\n5500,500,-15,20\n"));
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
    CHECK_THAT(problem(header + "0,1000,20,50\n0,990,20,50\n"), Contains(":3:1"));
    CHECK_THAT(problem(header + "0,1000,20,50\n100,1001,20,50\n"), Contains(":3:2"));
    CHECK_THAT(problem(header + "0,1000,200,50\n100,990,20,50\n"), Contains(":2:3"));
    CHECK_THAT(problem(header + "0,1000,nan,50\n100,990,20,50\n"), Contains(":2:3"));
    CHECK_THAT(problem(header + "0,1000,20,150\n100,990,20,50\n"), Contains(":2:4"));
    CHECK_THAT(problem("z,pressure_hPa\n0,1000\n1,900\n"), Contains("height_km"));
}
