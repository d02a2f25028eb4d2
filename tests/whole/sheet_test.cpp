#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "materials/base/units.hpp"
#include "render/picture/exr.hpp"
#include "scenes/run/job.hpp"
#include "tests/support/sheet_scene.hpp"

// Open meshes: both sides of a sheet have sky, sun, neighbours and air of their own. What is
// expected comes from the sums of a few squares each: a level square of a metre sends another, a
// height away, by the view factor of a point to a rectangle (Modest, configuration 3).

using namespace diurna;
using namespace diurna::testing::over_plain;
using std::numbers::pi;

namespace {

/// View factor of a level point to the rectangle from its foot to (x, y), a height h over it.
double to_corner(double x, double y, double h) {
    const double u = x / h, v = y / h, p = std::sqrt(1.0 + u * u), q = std::sqrt(1.0 + v * v);
    return (u / p * std::atan(v / p) + v / q * std::atan(u / q)) / (2.0 * pi);
}
/// To the square of a metre whose middle is (x, y) away.
double to_square(double x, double y, double h) {
    const double a = x - 0.5, b = x + 0.5, c = y - 0.5, d = y + 0.5;
    return to_corner(b, d, h) - to_corner(a, d, h) - to_corner(b, c, h) + to_corner(a, c, h);
}

/// Squares of a metre on the ground and, over its middle, of a sheet.
struct Squares {
    static constexpr int ground = 30, sheet = 12;
    double height;
    std::vector<double> on_ground = std::vector<double>(ground * ground),
                        on_sheet = std::vector<double>(sheet * sheet);

    static Eigen::Vector2d middle(int k, int across) {
        return {k % across - 0.5 * (across - 1), k / across - 0.5 * (across - 1)};
    }
    static bool covered(int g) { return middle(g, ground).cwiseAbs().maxCoeff() < 0.5 * sheet; }
    /// Σ F × what the other squares send; `rest` from elsewhere in the hemisphere.
    double from_sheet(int g, const std::vector<double>& sent, double rest) const {
        return gathered(middle(g, ground), sheet, sent, rest);
    }
    double from_ground(int s, const std::vector<double>& sent, double rest) const {
        return gathered(middle(s, sheet), ground, sent, rest);
    }
    double gathered(const Eigen::Vector2d& at, int across, const std::vector<double>& sent,
                    double rest) const {
        double sum = 0.0, seen = 0.0;
        for (int k = 0; k < across * across; ++k) {
            const Eigen::Vector2d away = middle(k, across) - at;
            const double factor = to_square(away.x(), away.y(), height);
            sum += factor * sent[std::size_t(k)];
            seen += factor;
        }
        return sum + (1.0 - seen) * rest;
    }
    /// Mean over the ground's squares between two distances of the middle.
    double mean(double from, double to) const {
        double sum = 0.0;
        int count = 0;
        for (int g = 0; g < ground * ground; ++g) {
            const double away = middle(g, ground).cwiseAbs().maxCoeff();
            if (away < from || away > to) continue;
            sum += on_ground[std::size_t(g)];
            ++count;
        }
        return sum / count;
    }
};

/// Root of heat − n (σ T⁴ + film (T − air)).
double balanced(double heat, int faces) {
    double t = air;
    for (int i = 0; i < 50; ++i) {
        const double left = heat - faces * (stefan_boltzmann * power4(t) + film * (t - air));
        t += left / (faces * (4.0 * stefan_boltzmann * t * t * t + film));
    }
    return t;
}

}  // namespace

// 500 W/m² in a black sheet go half to each side; everything else is as warm as the air.
TEST_CASE("a heated sheet warms the ground beneath it", "[whole][sheet]") {
    const std::string back =
        GENERATE("", "back = { kind = \"exposed\", emissivity = 1.0, albedo = 0.0 }");
    const double cold = stefan_boltzmann * power4(air), heat = 500.0;
    const Solved scene = solved({.mesh = level_square(12),
                                 .longwave = cold,
                                 .sheet = "internal_heat_W_m2 = 500.0\n" + back});
    Squares e{.height = 2.0};
    std::vector<double> ground(e.on_ground.size(), cold), sheet(e.on_sheet.size(), cold);
    for (int round = 0; round < 8; ++round) {
        for (int s = 0; s < 12 * 12; ++s) {
            e.on_sheet[std::size_t(s)] = balanced(heat + cold + e.from_ground(s, ground, cold), 2);
        }
        for (std::size_t s = 0; s < sheet.size(); ++s) {
            sheet[s] = stefan_boltzmann * power4(e.on_sheet[s]);
        }
        for (int g = 0; g < 30 * 30; ++g) {
            e.on_ground[std::size_t(g)] = balanced(e.from_sheet(g, sheet, cold), 1);
        }
        for (std::size_t g = 0; g < ground.size(); ++g) {
            ground[g] = stefan_boltzmann * power4(e.on_ground[g]);
        }
    }
    CAPTURE(back);
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
