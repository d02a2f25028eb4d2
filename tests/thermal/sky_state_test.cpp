#include "thermal/weather/sky_state.hpp"
#include "thermal/weather/sky_series.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"
#include "tests/support/measured_days.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;

namespace {

const Site site{.latitude_deg = 40.0, .longitude_deg = -88.0, .height = 200.0};
const Instant noon = parse_instant("2020-06-21T18:00:00Z");
const Instant midnight = parse_instant("2020-06-21T06:00:00Z");

}  // namespace

TEST_CASE("Dilley and O'Brien's sky at three climates", "[thermal][irradiance][a12]") {
    // reference/thermal/analytic_cases.md, A12.
    CHECK(clear_longwave({288.15, 1e5, 1000.0}) == Approx(293.945).margin(0.01));
    CHECK(clear_longwave({303.15, 1e5, 800.0}) == Approx(339.734).margin(0.01));
    CHECK(clear_longwave({263.15, 1e5, 200.0}) == Approx(186.717).margin(0.01));
    // Overcast is black at air temperature, and cloud only adds.
    CHECK(cloudy_longwave({288.15, 1e5, 1000.0}, 1.0) == Approx(stefan_boltzmann * power4(288.15)));
    CHECK(cloudy_longwave({288.15, 1e5, 1000.0}, 0.0) == clear_longwave({288.15, 1e5, 1000.0}));
}

TEST_CASE("clear skies by name give the table of A12", "[thermal][irradiance][a12]") {
    // reference/thermal/analytic_cases.md, A12, at three states of the air.
    struct Row {
        LongwaveFormula formula;
        double mild, warm, cold;
    };
    const auto row = GENERATE(Row{LongwaveFormula::brutsaert, 299.91, 353.308, 167.922},
                              Row{LongwaveFormula::brunt, 283.63, 337.071, 166.388},
                              Row{LongwaveFormula::prata, 303.44, 361.822, 190.076},
                              Row{LongwaveFormula::dilley_obrien, 293.945, 339.734, 186.717},
                              Row{LongwaveFormula::idso, 316.044, 367.347, 200.009},
                              Row{LongwaveFormula::swinbank, 303.953, 412.135, 176.325});
    CAPTURE(int(row.formula));
    CHECK(clear_longwave({288.15, 1e5, 1000.0}, row.formula) == Approx(row.mild).margin(0.03));
    CHECK(clear_longwave({303.15, 1e5, 800.0}, row.formula) == Approx(row.warm).margin(0.03));
    CHECK(clear_longwave({263.15, 1e5, 200.0}, row.formula) == Approx(row.cold).margin(0.03));
    // Crawford & Duchon: c σT⁴ + (1 − c) clear.
    CHECK(cloudy_longwave({288.15, 1e5, 1000.0}, 0.25, row.formula) ==
          Approx(0.25 * stefan_boltzmann * power4(288.15) + 0.75 * row.mild).margin(0.03));
}

TEST_CASE("Ineichen's sky is that of pvlib's test", "[thermal][irradiance][ineichen]") {
    // pvlib, test_ineichen_scalar_input: zenith 10°, absolute air mass 1, turbidity 3, sea level,
    // 1364 W/m² above the air: global 1038.159219, direct 942.2081860, diffuse 110.2652929.
    const double mass = 1.0 / (std::cos(radians(10.0)) + 0.50572 * std::pow(86.07995, -1.6364));
    const double distance = std::sqrt(solar_constant / 1364.0);
    const Sunlight sun = ineichen_clear_sky(80.0, distance, 101325.0 / mass, 0.0, 3.0);
    CHECK(sun.direct_normal == Approx(942.2081860).epsilon(1e-6));
    CHECK(sun.diffuse_horizontal == Approx(110.2652929).epsilon(1e-5));
    // Darker with haze, never more than a beam above the air.
    CHECK(ineichen_clear_sky(80.0, 1.0, 9e4, 1000.0, 6.0).direct_normal <
          ineichen_clear_sky(80.0, 1.0, 9e4, 1000.0, 2.0).direct_normal);
    CHECK(ineichen_clear_sky(-1.0, 1.0, 1e5, 0.0, 3.0).direct_normal == 0.0);
}

TEST_CASE("scattered light on a tilt is what pvlib has of Perez's model in Driesse's form",
          "[thermal][irradiance]") {
    // pvlib, test_perez_driesse: 40° to the south, 1321.1656 W/m² above the air.
    struct Row {
        double zenith_deg, azimuth_deg, direct, diffuse, on_tilt, even, circumsolar, horizon;
    };
    const auto row = GENERATE(
        Row{82.85457044, 66.71410338, 316.1949056, 40.46149818, 29.991, 25.806, 0.0, 4.184},
        Row{72.41687122, 287.04104128, 646.22886049, 62.03376265, 47.397, 33.181, 4.197, 10.018},
        // Of its last digits, in test_perez_driesse_scalar.
        Row{10.564, 144.765, 939.954, 118.458, 110.341, NAN, NAN, NAN});
    SkyState sky;
    sky.to_sun = direction(row.azimuth_deg, 90.0 - row.zenith_deg);
    sky.direct_normal = row.direct;
    sky.diffuse_horizontal = row.diffuse;
    sky.split = perez_split(row.direct, row.diffuse, row.zenith_deg, 1321.1655834833093);
    const Eigen::Vector3d normal = direction(180.0, 50.0);
    const double cosine = normal.dot(sky.to_sun), slope = radians(40.0);
    const double view = 0.5 * (1.0 + std::cos(slope));
    // The model's horizon is a line, sin(slope) of which an open plane sees.
    const OpenSky line{.view = view, .horizon = std::sin(slope)};
    const double direct = row.direct * std::max(0.0, cosine);
    CHECK(facet_sunlight(sky, cosine, 1.0, line) - direct == Approx(row.on_tilt).margin(2e-2));
    if (!std::isnan(row.even)) {
        // In shadow the circumsolar part goes with the beam.
        CHECK(facet_sunlight(sky, cosine, 0.0, {.view = view}) == Approx(row.even).margin(2e-2));
        CHECK(row.diffuse * sky.split.horizon * std::sin(slope) ==
              Approx(row.horizon).margin(2e-2));
    }
    // Ours is a band some degrees high: 1 % of the diffuse light.
    const OpenSky band{.view = view, .horizon = horizon_view(open_plane(normal.cast<float>()))};
    CHECK(facet_sunlight(sky, cosine, 1.0, band) - direct ==
          Approx(row.on_tilt).margin(0.01 * row.diffuse));
}

TEST_CASE("open planes see the horizon by the sine of their slope", "[thermal][irradiance]") {
    for (int slope_deg = 0; slope_deg <= 180; slope_deg += 5) {
        const double slope = radians(slope_deg);
        const double seen =
            horizon_view(open_plane(direction(130.0, 90.0 - slope_deg).cast<float>()));
        CAPTURE(slope_deg);
        CHECK(seen ==
              Approx(std::sin(slope)).margin(slope_deg % 90 == 0 && slope_deg < 180 ? 1e-3 : 0.05));
    }
}

TEST_CASE("modelled clear days miss a measured one by what others miss it",
          "[thermal][irradiance][measured]") {
    // reference/thermal/parameterisations.md, Alamosa's clear day, global / direct / diffuse, bias:
    // Bird (depth 0.02, 0.4 cm) −27 / −67 / −7, Ineichen (turbidity 2.2) −19 / −18 / −18 W/m².
    const auto folder = shared_data("data/thermal/surfrad_alamosa_20160101");
    if (!folder) return;
    const measured::Series series = measured::alamosa(*folder);
    const auto bias = [&](const ClearSky& clear) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        int count = 0;
        for (std::size_t i = 0; i < series.weather.sample.size(); i += 5) {
            const Forcing& measured = series.weather.sample[i];
            Forcing unmeasured = measured;
            unmeasured.shortwave_down = unmeasured.direct_normal = unmeasured.diffuse =
                unmeasured.shortwave_up = not_measured;
            const SkyState sky = sky_state(series.site, series.site.height,
                                           series.weather.instant[i], unmeasured, clear);
            if (sky.sun.elevation_deg < 5.0) continue;
            sum += Eigen::Vector3d(sky.global_horizontal() - measured.shortwave_down,
                                   sky.direct_normal - measured.direct_normal,
                                   sky.diffuse_horizontal - measured.diffuse);
            ++count;
        }
        return Eigen::Vector3d(sum / count);
    };
    const Eigen::Vector3d bird =
        bias({.aerosol_380nm = 0.02, .aerosol_500nm = 0.02, .precipitable_water_cm = 0.4});
    const Eigen::Vector3d ineichen = bias({.linke_turbidity = 2.2});
    WARN("Bird " << bird.transpose() << ", Ineichen " << ineichen.transpose() << " W/m²");
    CHECK((bird - Eigen::Vector3d(-27.0, -67.0, -7.0)).cwiseAbs().maxCoeff() < 10.0);
    CHECK((ineichen - Eigen::Vector3d(-19.0, -18.0, -18.0)).cwiseAbs().maxCoeff() < 10.0);
}

TEST_CASE("Bird's clear sky is that of NREL's worksheet",
          "[thermal][irradiance][bird][by_comparison]") {
    // BIRD_08_16_2012 as kept by pvlib: 1 January at 40° N, 1013.25 hPa, 0.3 cm ozone, 1.5 cm of
    // water, depths 0.1 and 0.15, albedo 0.2. It scatters 0.85 of what aerosol scatters forward,
    // the report (and we) 0.84.
    struct Row {
        double zenith_deg, direct, global;
    };
    const auto row = GENERATE(
        Row{63.37408378, 786.7361393, 447.9847462}, Row{66.6756093, 749.527781, 387.075664},
        Row{72.42741639, 663.3221901, 279.163603}, Row{80.20294173, 471.3212064, 133.8416817});
    const double distance = std::sqrt(solar_constant / 1414.91335);  // its light above the air
    const ClearSky clear{.aerosol_380nm = 0.15, .aerosol_500nm = 0.1};
    const double elevation = 90.0 - row.zenith_deg;
    const Sunlight sun = bird_clear_sky(elevation, distance, 101325.0, 1.5, clear);
    CAPTURE(row.zenith_deg);
    CHECK(sun.direct_normal == Approx(row.direct).epsilon(1e-4));
    const double sine = std::sin(radians(elevation));
    CHECK(sun.direct_normal * sine + sun.diffuse_horizontal == Approx(row.global).epsilon(3e-3));
}

TEST_CASE("Bird's clear sky brightens with height and dims with water and dust",
          "[thermal][irradiance]") {
    const Sunlight high = bird_clear_sky(60.0, 1.0, 101325.0, 1.5);
    // Bird & Hulstrom's own range for a clear 30° zenith: direct 850 to 1000, diffuse 60 to 130.
    CHECK(high.direct_normal > 850.0);
    CHECK(high.direct_normal < 1000.0);
    CHECK(high.diffuse_horizontal > 60.0);
    CHECK(high.diffuse_horizontal < 130.0);
    CHECK(bird_clear_sky(60.0, 1.0, 70000.0, 1.5).direct_normal > high.direct_normal);
    CHECK(bird_clear_sky(60.0, 1.0, 101325.0, 4.0).direct_normal < high.direct_normal);
    ClearSky dusty;
    dusty.aerosol_380nm = 0.5;
    dusty.aerosol_500nm = 0.4;
    const Sunlight dust = bird_clear_sky(60.0, 1.0, 101325.0, 1.5, dusty);
    CHECK(dust.direct_normal < 0.85 * high.direct_normal);
    CHECK(dust.diffuse_horizontal > 1.5 * high.diffuse_horizontal);
    CHECK(bird_clear_sky(-1.0, 1.0, 101325.0, 1.5).direct_normal == 0.0);
    CHECK(bird_clear_sky(0.01, 1.0, 101325.0, 1.5).direct_normal < 40.0);
}

TEST_CASE("measured sun wins, and the horizontal facet gets exactly what was measured",
          "[thermal][irradiance]") {
    Forcing forcing;
    forcing.shortwave_down = 600.0;
    const double direct = GENERATE(not_measured, 500.0);
    const double diffuse = GENERATE(not_measured, 250.0);
    forcing.direct_normal = direct;
    forcing.diffuse = diffuse;
    for (const Instant when : {noon, midnight, parse_instant("2020-06-21T10:25:00Z")}) {
        const SkyState sky = sky_state(site, 200.0, when, forcing);
        CAPTURE(direct, diffuse, sky.sun.elevation_deg);
        CHECK(sky.global_horizontal() == Approx(600.0).epsilon(1e-12));
        const double flat = facet_sunlight(sky, sky.to_sun.z(), 1.0, {});
        CHECK(flat == Approx(600.0).epsilon(1e-12));
    }
    const SkyState sky = sky_state(site, 200.0, midnight, forcing);
    CHECK(sky.direct_normal == 0.0);
}

TEST_CASE("a facet in shadow keeps only the even part of the sky it sees",
          "[thermal][irradiance]") {
    const SkyState sky = sky_state(site, 200.0, noon, Forcing{});
    const double even = sky.diffuse_horizontal * (1.0 - sky.split.circumsolar);
    CHECK(facet_sunlight(sky, 0.7, 0.0, {.view = 0.5}) == Approx(0.5 * even));
    CHECK(facet_sunlight(sky, -0.3, 1.0, {.view = 0.5}) == Approx(0.5 * even));
    const double facing = facet_sunlight(sky, 1.0, 1.0, {.view = 0.8});
    CHECK(facing ==
          Approx(sky.direct_normal +
                 sky.diffuse_horizontal * sky.split.circumsolar / sky.to_sun.z() + 0.8 * even));
    CHECK(sky.split.circumsolar > 0.2);
}

TEST_CASE("cloud is inferred from dimmed sun and held through the night", "[thermal][irradiance]") {
    Weather weather;
    for (int h = 0; h < 48; ++h) {
        const Instant when = later(midnight, 3600.0 * h);
        Forcing forcing;
        const SkyState clear = sky_state(site, 200.0, when, forcing);
        forcing.shortwave_down = 0.4 * clear.global_horizontal();
        weather.instant.push_back(when);
        weather.sample.push_back(forcing);
    }
    weather = SkySeries(weather, site, 200.0, {}, weather.instant.front(), weather.instant.back())
                  .weather();
    for (const Forcing& forcing : weather.sample) {
        CHECK(forcing.cloud_fraction == Approx(0.6).margin(1e-9));
    }
    const SkyState night = sky_state(site, 200.0, midnight, weather.sample[0]);
    CHECK(night.longwave_down == Approx(cloudy_longwave(weather.sample[0].air, 0.6)));
}

TEST_CASE("up over down is the albedo where both are measured", "[thermal][irradiance]") {
    Forcing forcing;
    forcing.shortwave_down = 500.0;
    forcing.shortwave_up = 120.0;
    CHECK(sky_state(site, 200.0, noon, forcing).albedo == Approx(0.24));
    forcing.shortwave_down = 2.0;
    CHECK(std::isnan(sky_state(site, 200.0, noon, forcing).albedo));
}

TEST_CASE("Erbs's diffuse share is one under overcast and small in clear air",
          "[thermal][irradiance]") {
    CHECK(erbs_diffuse_share(0.0) == 1.0);
    CHECK(erbs_diffuse_share(0.22) == Approx(0.9802));
    CHECK(erbs_diffuse_share(0.5) == Approx(0.9511 - 0.0802 + 1.097 - 2.07975 + 0.771));
    CHECK(erbs_diffuse_share(0.9) == 0.165);
}

TEST_CASE("a tilted facet sees the brighter sky near the horizon", "[thermal][irradiance][tilt]") {
    constexpr double b = 0.09;  // Unsworth & Monteith 1975
    // Level: the flux itself, in digits. A wall: (2/π) ∫ (−ln cos z − ½) sin² z dz = ½ ln 2.
    const auto open = [](double slope_deg) {
        return tilted_sky_excess(open_plane(direction(70.0, 90.0 - slope_deg).cast<float>()));
    };
    CHECK(open(0.0) == Approx(0.0).margin(1e-6));
    CHECK(open(90.0) == Approx(0.5 * b * std::log(2.0)).epsilon(1e-3));
    CHECK(open(180.0) == Approx(0.0).margin(1e-6));
    // A level facet in a round basin loses the brightest rim: ½ b (1 − V) ln(1 − V).
    const double view = GENERATE(0.3, 0.75, 0.95);
    CHECK(tilted_sky_excess(plane_behind_ring(Eigen::Vector3f::UnitZ(), view)) ==
          Approx(0.5 * b * (1.0 - view) * std::log(1.0 - view)).epsilon(5e-3));
}

TEST_CASE("the tilted sky's rise follows the sky: none under cloud, none in a furnace",
          "[thermal][irradiance][tilt]") {
    Forcing f;
    f.air = {.temperature = 290.0, .pressure = 1e5, .vapour_pressure = 1200.0};
    const double black = stefan_boltzmann * power4(290.0);
    const auto rise = [&] { return sky_state(site, 200.0, noon, f).tilted_longwave; };
    CHECK(rise() == Approx(black));
    f.cloud_fraction = 0.7;
    CHECK(rise() == Approx(0.3 * black));
    // Measured longwave reports its own cloud (Crawford & Duchon).
    f.cloud_fraction = not_measured;
    f.longwave_down = cloudy_longwave(f.air, 0.7);
    CHECK(rise() == Approx(0.3 * black).epsilon(1e-9));
    f.longwave_down = black;
    CHECK(rise() == 0.0);
    f.longwave_down = 0.0;  // no air above: nothing to rise
    CHECK(rise() == 0.0);
    CHECK(sky_state(site, 200.0, noon, f, {.longwave_by_direction = false}).tilted_longwave == 0.0);
}
