#include "materials/air/profile.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/error.hpp"

using namespace diurna;

namespace {

constexpr auto water = static_cast<std::size_t>(Gas::water);

}  // namespace

TEST_CASE("the six AFGL models have their published ground values",
          "[materials][profile][by_comparison]") {
    // AFGL-TR-86-0110, tables 1a to 1f: pressure [hPa], temperature [K], water vapour [ppm].
    struct Ground {
        const char* name;
        double pressure, temperature, water;
    };
    for (const auto& [name, pressure, temperature, vapour] :
         {Ground{"TROP", 1013, 299.7, 25930}, Ground{"MLS", 1013, 294.2, 18760},
          Ground{"MLW", 1018, 272.2, 4316}, Ground{"SAS", 1010, 287.2, 11940},
          Ground{"SAW", 1013, 257.2, 1405}, Ground{"US76", 1013, 288.2, 7745}}) {
        const AirSample air = air_at(afgl_profile(name), 0.0);
        CAPTURE(name);
        CHECK(air.pressure_hPa == pressure);
        CHECK(air.temperature == temperature);
        CHECK(air.mixing_ratio_ppm[water] == Approx(vapour));
        CHECK(air.mixing_ratio_ppm[static_cast<std::size_t>(Gas::carbon_dioxide)] == 330.0);
    }
    CHECK(afgl_profile_names().size() == 6);
}

TEST_CASE("an unknown profile is answered with the nearest", "[materials][profile]") {
    CHECK_THROWS_WITH(afgl_profile("US67"), Catch::Contains("did you mean 'US76'?"));
}

TEST_CASE("pressure and mixing ratios are interpolated in their logarithm",
          "[materials][profile]") {
    const Profile profile = afgl_profile("MLS");
    const AirSample low = air_at(profile, 2.0), high = air_at(profile, 3.0);
    const AirSample middle = air_at(profile, 2.5);
    CHECK(middle.pressure_hPa == Approx(std::sqrt(low.pressure_hPa * high.pressure_hPa)));
    CHECK(middle.mixing_ratio_ppm[water] ==
          Approx(std::sqrt(low.mixing_ratio_ppm[water] * high.mixing_ratio_ppm[water])));
    CHECK(middle.temperature == Approx(0.5 * (low.temperature + high.temperature)));
    CHECK(air_at(profile, -1.0).pressure_hPa == profile.pressure_hPa.front());
    CHECK(air_at(profile, 1e6).temperature == profile.temperature.back());
}

TEST_CASE("the day's weather reaches the boundary layer and no higher", "[materials][profile]") {
    const Profile before = afgl_profile("MLS");
    const double ground_km = 0.31;
    const Profile after = with_surface(before, ground_km, 303.0, 12.0);
    check(after);
    const AirSample ground = air_at(after, ground_km);
    CHECK(ground.temperature == Approx(303.0));
    CHECK(ground.pressure_hPa * ground.mixing_ratio_ppm[water] * 1e-6 == Approx(12.0));
    CHECK(ground.pressure_hPa == Approx(air_at(before, ground_km).pressure_hPa));
    for (const double km : {1.81, 2.0, 5.0, 30.0}) {
        CHECK(air_at(after, km).temperature == Approx(air_at(before, km).temperature));
        CHECK(air_at(after, km).mixing_ratio_ppm[water] ==
              Approx(air_at(before, km).mixing_ratio_ppm[water]));
    }
    // Half way up half of the change is left.
    const double half_way = air_at(before, 1.0).temperature;
    const double share = (1.81 - 1.0) / 1.5;
    CHECK(air_at(after, 1.0).temperature - half_way ==
          Approx(share * (303.0 - air_at(before, ground_km).temperature)));
}

TEST_CASE("weather at a level's own height adds no level twice", "[materials][profile]") {
    const Profile after = with_surface(afgl_profile("US76"), 0.0, 290.0, 8.0, 1.0);
    CHECK(after.height_km.size() == afgl_profile("US76").height_km.size());
    CHECK(after.temperature.front() == Approx(290.0));
}

TEST_CASE("profiles that make no sense are refused", "[materials][profile]") {
    const Profile good = afgl_profile("US76");
    CHECK_NOTHROW(check(good));
    Profile bad = good;
    std::swap(bad.height_km[3], bad.height_km[4]);
    CHECK_THROWS_WITH(check(bad), Catch::Contains("ascend"));
    bad = good;
    bad.pressure_hPa[2] = -1.0;
    CHECK_THROWS_WITH(check(bad), Catch::Contains("-1 hPa"));
    bad = good;
    bad.temperature[2] = std::nan("");
    CHECK_THROWS_WITH(check(bad), Catch::Contains("nan K"));
    bad = good;
    bad.mixing_ratio_ppm[water].pop_back();
    CHECK_THROWS_WITH(check(bad), Catch::Contains("differ in length"));
    CHECK_THROWS_AS(check(Profile{}), InputError);
}
