#include "materials/air/seasonal_profile.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "materials/air/radiosonde.hpp"
#include "materials/atmosphere/ground_fluxes.hpp"
#include "materials/base/files.hpp"

using namespace diurna;

namespace {

/// Water above the ground [kg m⁻²].
double column_of(const Profile& profile) {
    double column = 0.0;
    for (std::size_t i = 1; i < profile.height_km.size(); ++i) {
        const auto density = [&](std::size_t level) {  // [kg m⁻³]
            return 100.0 * sample_of(profile, level).vapour_pressure_hPa() /
                   (461.5 * profile.temperature[level]);
        };
        column += 500.0 * (profile.height_km[i] - profile.height_km[i - 1]) *
                  (density(i) + density(i - 1));
    }
    return column;
}

double saturation_hPa(double temperature) {  // Bolton 1980
    const double t = temperature - 273.15;
    return 6.112 * std::exp(17.67 * t / (t + 243.5));
}

}  // namespace

TEST_CASE("a clear sky over air of any season sends the longwave of published skies",
          "[materials][air][flux][by_comparison]") {
    // Dilley and O'Brien 1998 (rms 5 W m-2 against line-by-line): 59.38 + 113.7 (T/273.16)^6 +
    // 96.96 sqrt(w / 25), with the column w of Prata 1996: 46.5 e0 / T [kg m-2], e0 in hPa.
    double of_summer = 0.0, worst = 0.0;
    for (const double temperature : {258.0, 265.0, 275.0, 283.0, 290.0, 298.0}) {
        const double vapour = 0.6 * saturation_hPa(temperature);
        const double water = 10.0 * 46.5 * vapour / temperature;
        const double expected =
            59.38 + 113.7 * std::pow(temperature / 273.16, 6) + 96.96 * std::sqrt(water / 25.0);
        const auto sent = [&](const Profile& above) {
            BandModel air{.profile = with_surface(above, 0.0, temperature, vapour),
                          .aerosol = "none"};
            return ground_fluxes(air, {}, 0.0).thermal;
        };
        const Profile above = seasonal_profile(0.0, temperature);
        const double found = sent(above), summer = sent(afgl_profile("MLS"));
        fmt::print(
            "  clear sky at {:.0f} K: {:.1f}, Dilley-O'Brien {:.1f}, MLS {:.1f} W m-2 ({})\n",
            temperature, found, expected, summer, above.name);
        CAPTURE(temperature, above.name);
        CHECK(found == Approx(expected).epsilon(0.05));
        worst = std::max(worst, std::abs(found - expected));
        of_summer = std::max(of_summer, std::abs(summer - expected));
    }
    CHECK(of_summer > 3.0 * worst);  // what one season for all costs
}

TEST_CASE("the air above follows the temperature without a step", "[materials][air]") {
    for (const double height_km : {0.0, 1.5, 4.0}) {
        Profile last = seasonal_profile(height_km, 240.0);
        CHECK(last.name == "SAW");
        CHECK(last.winter);
        for (double temperature = 240.1; temperature < 310.0; temperature += 0.1) {
            const Profile next = seasonal_profile(height_km, temperature);
            check(next);
            CAPTURE(height_km, temperature, next.name);
            const double below = pressure_and_temperature_at(next, height_km).second;
            if (next.name.find('%') != std::string::npos) CHECK(below == Approx(temperature));
            for (std::size_t i = 0; i < next.height_km.size(); ++i) {
                CHECK(std::abs(next.temperature[i] - last.temperature[i]) < 1.0);
                CHECK(next.pressure_hPa[i] == Approx(last.pressure_hPa[i]).epsilon(0.01));
            }
            CHECK(column_of(next) == Approx(column_of(last)).epsilon(0.03));
            last = next;
        }
        CHECK(last.name == "TROP");
        CHECK(!last.winter);
    }
}

TEST_CASE("a sounding without a named model continues with the air of its season",
          "[materials][air][radiosonde]") {
    const auto above = [](double offset) {
        std::string text = "height_m,pressure_hPa,temperature_K,relative_humidity_percent\n";
        for (int km = 0; km <= 6; ++km) {
            text += fmt::format("{},{},{},40\n", 1000 * km, 1013.25 * std::exp(-km / 8.0),
                                afgl_profile("US76").temperature[std::size_t(km)] + offset);
        }
        const auto file = std::filesystem::temp_directory_path() / "diurna_season_test.csv";
        write_whole_file(file, text);
        return read_radiosonde(file);
    };
    const Profile cold = above(-20.0), warm = above(20.0);
    CHECK(cold.winter);
    CHECK(!warm.winter);
    // Its ozone is the season's: AFGL's SAW and MLS at 20 km.
    constexpr auto ozone = static_cast<std::size_t>(Gas::ozone);
    CHECK(air_at(cold, 20.0).mixing_ratio_ppm[ozone] >
          1.2 * air_at(warm, 20.0).mixing_ratio_ppm[ozone]);
}
