#include "materials/atmosphere/ground_fluxes.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"

using namespace diurna;

namespace {

BandModel model(const std::string& profile, const std::string& aerosol = "none",
                double visibility_km = 23.0) {
    return {.profile = afgl_profile(profile), .aerosol = aerosol, .visibility_km = visibility_km};
}

}  // namespace

TEST_CASE("thermal flux at the ground is that of published skies",
          "[materials][flux][by_comparison]") {
    // Dilley and O'Brien 1998, fitted to line-by-line fluxes, rms 5 W m-2: 59.38 + 113.7
    // (T/273.16)^6
    // + 96.96 sqrt(w / 25) with AFGL's temperatures and columns [kg m-2].
    struct Sky {
        const char* profile;
        double temperature, water;
    };
    for (const auto& [profile, temperature, water] :
         {Sky{"TROP", 299.7, 41.1}, Sky{"MLS", 294.2, 29.2}, Sky{"MLW", 272.2, 8.5},
          Sky{"SAS", 287.2, 20.8}, Sky{"SAW", 257.2, 4.2}, Sky{"US76", 288.2, 14.2}}) {
        const double expected =
            59.38 + 113.7 * std::pow(temperature / 273.16, 6) + 96.96 * std::sqrt(water / 25.0);
        const double found = ground_fluxes(model(profile), {}, 0.0).thermal;
        fmt::print("  thermal sky {:>5}: {:.1f}, Dilley-O'Brien {:.1f} W m-2\n", profile, found,
                   expected);
        CAPTURE(profile);
        CHECK(found == Approx(expected).epsilon(0.06));
    }
}

TEST_CASE("clouds warm the ground by what they are warmer than the sky", "[materials][flux]") {
    BandModel air = model("US76");
    const double clear = ground_fluxes(air, {}, 0.0).thermal;
    air.cloud = {.fraction = 1.0, .base_km = 0.001, .temperature = 285.0};
    CHECK(
        ground_fluxes(air, {}, 0.0).thermal ==
        Approx(stefan_boltzmann * std::pow(285.0, 4)).epsilon(0.012));  // beyond 100 um, below 3.5
    air.cloud.fraction = 0.4;
    air.cloud.base_km = 1.0;
    const double some = ground_fluxes(air, {}, 0.0).thermal;
    air.cloud.fraction = 1.0;
    CHECK(some == Approx(clear + 0.4 * (ground_fluxes(air, {}, 0.0).thermal - clear)));
}

TEST_CASE("broadband sun of a clear day", "[materials][flux]") {
    // ASTM G173 at air mass 1.5: 900 W m-2 direct normal with an aerosol depth of 0.084 at 0.5 um;
    // rural air of 100 km visibility has about that.
    const GroundFluxes day =
        ground_fluxes(model("US76", "rural", 100.0), {.zenith_deg = 48.19}, 0.0);
    fmt::print("  G173's day: direct {:.0f} (900), diffuse {:.0f} W m-2\n", day.sun_direct,
               day.sun_diffuse);
    CHECK(day.sun_direct == Approx(900.0).epsilon(0.05));
    CHECK(day.sun_diffuse > 50.0);
    CHECK(day.sun_diffuse < 120.0);
    CHECK(ground_fluxes(Vacuum{}, {.zenith_deg = 30.0}, 0.0).sun_diffuse == 0.0);
}
