#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "materials/base/units.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/level_squares.hpp"

// Open meshes: both sides of a sheet have sky, sun, neighbours and air of their own. What is
// expected comes from sums over squares of a metre (level_squares.hpp).

using namespace diurna;
using namespace diurna::testing::over_plain;

// 500 W/m² in a black sheet go half to each side; everything else is as warm as the air.
TEST_CASE("a heated sheet warms the ground beneath it", "[whole][sheet]") {
    const std::string back =
        GENERATE("", "back = { kind = \"exposed\", emissivity = 1.0, albedo = 0.0 }");
    const bool again = GENERATE(false, true);
    const Solved scene = heated_sheet(back, again);
    const Squares e = under_heated_sheet();
    CAPTURE(back, again);
    const auto warming = [&](double from, double to) {
        return scene.kelvin("12:00", true, from, to) - air;
    };
    REQUIRE(e.mean(0.0, 2.0) - air > 5.0);
    CHECK(warming(0.0, 2.0) == Approx(e.mean(0.0, 2.0) - air).epsilon(0.03));
    CHECK(warming(4.0, 6.0) == Approx(e.mean(4.0, 6.0) - air).epsilon(0.03));
    CHECK(warming(7.0, 10.0) == Approx(e.mean(7.0, 10.0) - air).margin(0.1));
    CHECK(scene.kelvin("12:00", false, 0.0, 2.0) == Approx(e.on_sheet[6 * 12 + 6]).margin(0.1));
    CHECK(scene.kelvin("12:00", false, 0.0, 2.0, false) ==
          Approx(e.on_sheet[6 * 12 + 6]).margin(0.1));
}

// Nothing emits: what a face of film h absorbs of sunlight warms it by that over h. The sun is in
// the zenith; ground and sheet reflect a half, so that light comes to and fro from the sides.
TEST_CASE("ground under a sheet has the light that enters at the sides", "[whole][sheet]") {
    const double beam = 800.0, albedo = 0.5;
    const Given given{.mesh = level_square(12), .beam = beam, .albedo = albedo, .black = 0.0};
    Squares e{.height = 2.0};
    std::vector<double> ground(e.on_ground.size()), sheet(e.on_sheet.size());
    for (int round = 0; round < 30; ++round) {
        for (int g = 0; g < 30 * 30; ++g) {
            e.on_ground[std::size_t(g)] =
                (Squares::covered(g) ? 0.0 : beam) + e.from_sheet(g, sheet, 0.0);
            ground[std::size_t(g)] = albedo * e.on_ground[std::size_t(g)];
        }
        for (int s = 0; s < 12 * 12; ++s) {
            sheet[std::size_t(s)] = albedo * e.from_ground(s, ground, albedo * beam);
        }
    }
    Given slab = given;
    slab.mesh = level_square(12, 0.02);
    const Solved open = solved(given), closed = solved(slab);
    for (const double to : {2.0, 5.0}) {
        const double expected = (1.0 - albedo) * e.mean(to - 2.0, to) / film;
        CAPTURE(to);
        CHECK(open.kelvin("12:10", true, to - 2.0, to) - air ==
              Approx(expected).epsilon(0.03).margin(0.05));
        CHECK(open.kelvin("12:10", true, to - 2.0, to) ==
              Approx(closed.kelvin("12:10", true, to - 2.0, to)).margin(0.3));
    }
    CHECK(open.kelvin("12:10", true, 14.0, 15.0) - air ==
          Approx((1.0 - albedo) * beam / film).epsilon(0.01));
}

// A closed flat box of net encloses nothing: two layers that let through t = 1 − c and reflect r =
// c ρ each. Adding them (Stokes 1862): T = t²/(1 − r²), R = r + t² r/(1 − r²); over ground that
// reflects ρ there arrives T/(1 − R ρ). Under a box of black net
// the ground took 0.40 for 0.36 of the sun.
TEST_CASE("a closed box of net is two nets", "[whole][sheet]") {
    const double beam = 800.0, albedo = 0.5, cover = 0.6;
    const Solved under = solved({.mesh = level_square(12, 0.02),
                                 .height = 0.2,
                                 .beam = beam,
                                 .albedo = albedo,
                                 .black = 0.0,
                                 .sheet = "cover = 0.6\n"});
    const double t = 1.0 - cover, r = cover * albedo;
    const double through = t * t / (1.0 - r * r), back = r + r * through;
    const double arriving = beam * through / (1.0 - back * albedo);
    CHECK(under.kelvin("12:10", true, 0.0, 3.0) - air ==
          Approx((1.0 - albedo) * arriving / film).epsilon(0.02));
}

// An upright sheet that faces west, on black ground, at 9 h: the sun, 45° high in the east, falls
// on its back; both faces give their heat to the air. At 15 h it falls on its front.
TEST_CASE("the sun heats an upright sheet from either side", "[whole][sheet]") {
    const double beam = 800.0;
    const Solved scene = solved(
        {.mesh = "v 0 -2 0\nv 0 2 0\nv 0 2 2\nv 0 -2 2\nf 4 3 2 1\n", .beam = beam, .black = 0.0});
    const FacetSet& facets = scene.prepared.world.facets;
    const auto sheet = [&](const char* time) {
        const std::vector<float> all =
            scene.temperature.interpolate(parse_instant(std::string("2026-03-20T") + time));
        double sum = 0.0, area = 0.0;
        for (std::size_t f = scene.prepared.world.ground_facets; f < facets.size(); ++f) {
            sum += double(facets.area[f]) * double(all[f]);
            area += double(facets.area[f]);
        }
        CHECK(area == Approx(2.0 * 8.0).epsilon(1e-4));
        return sum / area - air;
    };
    // The equation of time is −7.5 minutes: the hour angle is 46.9° and 43.1°.
    CHECK(sheet("09:00:00Z") ==
          Approx(beam * std::sin(radians(46.9)) / (2.0 * film)).epsilon(0.01));
    CHECK(sheet("15:00:00Z") ==
          Approx(beam * std::sin(radians(43.1)) / (2.0 * film)).epsilon(0.01));
}

// Without radiation a surface that gives its vapour to the air as freely as its heat is at the wet
// bulb, c_p (T_air − T) = 0.622 L / p (e_s(T) − e): 290 K and half of saturation, 1000 hPa, with
// Bolton's e_s (1980) and L = 2.5008 − 0.002372 (T − 273.15) MJ/kg (Stull 1988), c_p of the moist
// air. With a dry back two faces bring heat and one gives vapour.
TEST_CASE("both sides of a wet sheet evaporate", "[whole][sheet]") {
    const std::string evaporates =
        "evaporation = { kind = \"resistance\", minimum_s_m = 0.0, wetness = 1.0 }\n";
    const auto mean = [&](const std::string& back, const std::string& layer) {
        const Solved scene = solved(
            {.mesh = level_square(2), .black = 0.0, .sheet = evaporates + back, .layer = layer});
        CHECK(scene.kelvin("12:00", false, 0.0, 1.0, false) ==
              Approx(scene.kelvin("12:00", false, 0.0, 1.0)).margin(0.05));
        return scene.kelvin("12:00", false, 0.0, 1.0);
    };
    const auto saturation = [](double t) {
        return 611.2 * std::exp(17.67 * (t - 273.15) / (t - 29.65));
    };
    const double vapour = 0.5 * saturation(air), pressure = 1e5;
    const auto wet_bulb = [&](double faces_of_heat) {
        double low = 260.0, high = air;
        for (int i = 0; i < 60; ++i) {
            const double t = 0.5 * (low + high);
            const double q = 0.622 * vapour / pressure;
            const double given = faces_of_heat * (1004.7 + 850.0 * q) * (air - t);
            const double latent = 2.5008e6 - 2372.0 * (t - 273.15);
            const double taken = 0.622 * latent / pressure * (saturation(t) - vapour);
            (given > taken ? low : high) = t;
        }
        return low;
    };
    const std::string dry = "back = { kind = \"exposed\", emissivity = 0.0, albedo = 0.0 }";
    const std::string thin = "thickness_m = 0.001, conductivity_W_mK = 50.0";
    CHECK(mean("", thin) == Approx(wet_bulb(1.0)).margin(0.1));
    CHECK(mean(dry, thin) == Approx(wet_bulb(2.0)).margin(0.1));
    REQUIRE(wet_bulb(2.0) - wet_bulb(1.0) > 1.0);
}

// Turned over, an upright sheet between two boxes that shade it by turns is as warm at any time:
// the back's sun comes and goes within steps as the front's.
TEST_CASE("which side of a sheet is its front makes no difference", "[whole][sheet][sun]") {
    const std::string boxes = block(6.0, 8.0, -10.0, 2.0, 9.0) + block(-9.0, -7.0, -3.0, 0.3, 6.0);
    const auto mean = [&](const char* faces) {
        const Solved scene =
            solved({.mesh = "v 0 -1 1\nv 0 1 1\nv 0 1 3\nv 0 -1 3\n" + std::string(faces) + boxes,
                    .beam = 850.0,
                    .longwave = 330.0,
                    .albedo = 0.2,
                    .black = 0.9,
                    .frame_every = 600.0,
                    .sun_samples = 128,
                    .ground_edge = 10.0});
        const FacetSet& facets = scene.prepared.world.facets;
        std::vector<double> kelvin(scene.temperature.instant.size());
        double area = 0.0;
        for (std::size_t f = scene.prepared.world.ground_facets; f < facets.size(); ++f) {
            // The mesh stands with its middle, half a metre west of the sheet, on the place.
            if (std::abs(facets.centroid[f].x() - 0.5f) > 0.1f) continue;
            if (facets.normal[f].x() < 0.9f) continue;
            area += double(facets.area[f]);
            for (std::size_t i = 0; i < kelvin.size(); ++i) {
                kelvin[i] += double(facets.area[f]) * double(scene.temperature.at(i)[f]);
            }
        }
        CHECK(area == Approx(4.0).epsilon(1e-4));
        for (double& k : kelvin) k /= area;
        return kelvin;
    };
    const std::vector<double> one = mean("f 1 2 3 4\n"), other = mean("f 4 3 2 1\n");
    const auto [coldest, warmest] = std::minmax_element(one.begin(), one.end());
    CHECK(*warmest - *coldest > 20.0);
    for (std::size_t i = 0; i < one.size(); ++i) {
        CAPTURE(i);
        CHECK(one[i] == Approx(other[i]).margin(0.4));
    }
}

// Nothing emits: where the sun shines a thin sheet is warmer than the air by the beam over the
// films of its two faces, in the shadow of a pole as warm as the air, though none of its facets of
// two metres lies in that shadow wholly.
TEST_CASE("a narrow shadow on large facets of a sheet is as cold as the air",
          "[whole][sheet][sun]") {
    const std::string sheet = "v 0 -4 0\nv 0 4 0\nv 0 4 4\nv 0 -4 4\n",
                      faces = GENERATE("f 1 2 3 4\n", "f 4 3 2 1\n");
    const double beam = 800.0;
    const ScratchFolder folder("narrow");
    write_scene(folder.path, {.mesh = sheet + faces + block(3.0, 3.3, -0.25, 0.25, 9.0),
                              .height = 0.0,
                              .beam = beam,
                              .black = 0.0,
                              .frame_every = 3600.0,
                              .observer = "place_m = [14.0, -14.0]\nheight_above_ground_m = 4.0\n"
                                          "look_at_m = [-1.6, 0.0]\nhorizontal_fov_deg = 12.0\n"
                                          "surfaces = 1\n"});
    JobOptions options;
    options.out = folder.path / "out";
    options.progress = ProgressStyle::silent;
    run_job(read_scene(folder.path / "scene.toml"), options);
    const Frame frame = read_exr(folder.path / "out/frames/o_8-12_20260320T090000Z.exr");
    const double whole = beam * std::sin(radians(46.9)) / (2.0 * film);
    int shaded = 0, lit = 0;
    for (std::size_t p = 0; p < frame.pixels(); ++p) {
        if (frame["weight_1"].pixel[p] < 0.999f || frame["normal.X"].pixel[p] < 0.9f) continue;
        if (std::abs(frame["range"].pixel[p] - 21.0f) > 4.0f) continue;  // the pole is nearer
        const double share = double(frame["sun_fraction_1"].pixel[p]);
        shaded += share == 0.0;
        lit += share == 1.0;
        CAPTURE(faces, share);
        REQUIRE(double(frame["temperature_1"].pixel[p]) ==
                Approx(air + share * whole).margin(0.02 * whole));
    }
    CHECK(shaded > 5);
    CHECK(lit > 100);
}

// 5 cm of felt, heated in front: a slab between two films in steady state. A camera below it looks
// at its underside, one above at its front.
TEST_CASE("a camera below a sheet sees its underside", "[whole][sheet]") {
    const bool below = GENERATE(true, false);
    const double cold = stefan_boltzmann * power4(air), heat = 300.0, conductance = 0.04 / 0.05;
    double front = air, back = air;
    for (int i = 0; i < 200; ++i) {
        front = balanced(heat + cold - conductance * (front - back), 1);
        back = balanced(cold + conductance * (front - back), 1);
    }
    REQUIRE(front - back > 10.0);
    const ScratchFolder folder("underside");
    write_scene(folder.path,
                {.mesh = level_square(2),
                 .height = 12.0,
                 .longwave = cold,
                 .sheet = "internal_heat_W_m2 = 300.0\n",
                 .layer = "thickness_m = 0.05, conductivity_W_mK = 0.04",
                 .observer = std::string("place_m = [0.0, 0.0]\nazimuth_deg = 0.0\n") +
                             (below ? "height_above_ground_m = 4.0\nelevation_deg = 90.0\n"
                                    : "height_above_ground_m = 20.0\nelevation_deg = -90.0\n") +
                             "horizontal_fov_deg = 6.0\n"});
    JobOptions options;
    options.out = folder.path / "out";
    options.progress = ProgressStyle::silent;
    run_job(read_scene(folder.path / "scene.toml"), options);
    const Frame frame = read_exr(folder.path / "out/frames/o_8-12_20260320T120000Z.exr");
    CAPTURE(below);
    for (const float kelvin : frame["apparent_temperature.8-12"].pixel) {
        REQUIRE(kelvin == Approx(below ? back : front).margin(0.1));
    }
}
