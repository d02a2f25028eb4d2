#include "scenes/job/world/rain_cover.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "materials/base/files.hpp"
#include "tests/support/sheet_scene.hpp"

// Drops that fall straight down: expected values are plane geometry.

using namespace diurna;
using namespace diurna::testing;

namespace {

/// A sheet of 10 by 10 m over a plain, an hour of rain or snow (8 mm in all) from noon on.
struct Sheltered {
    std::string sheet{};   // keys of its material
    std::string object{};  // further keys of the object
    double air = 285.0;    // [K]
    double height = 4.0;   // [m]
};

Prepared prepared_of(const Sheltered& s, const std::filesystem::path& folder) {
    over_plain::write_scene(folder, {.mesh = over_plain::level_square(10),
                                     .height = s.height,
                                     .longwave = 300.0,
                                     .sheet = s.sheet});
    std::string text = read_text(folder / "scene.toml");
    text = with(text, "[[object]]\n", "[[object]]\n" + s.object);
    text = with(text, "roughness_length_m = 0.01\n",
                "roughness_length_m = 0.01\nstore = { capacity_mm = 2.0 }\n");
    text = with(text, "[time]\n", "[time]\nspin_up = \"steady\"\n");
    write_text(folder / "scene.toml", text);
    std::string weather =
        "time,air_temperature_K,relative_humidity,wind_speed_m_s,rain_mm_h,"
        "direct_normal_W_m2,diffuse_W_m2,longwave_down_W_m2\n";
    for (int h = 0; h <= 24; ++h) {
        weather += fmt::format("2026-03-{:02}T{:02}:00:00Z,{},0.9,3,{},0,0,300\n", 20 + h / 24,
                               h % 24, s.air, h >= 20 && h <= 24 ? 2 : 0);
    }
    write_text(folder / "weather.csv", weather);
    return prepare(read_scene(folder / "scene.toml"));
}

/// ∫ 1 − open over the ground [m²].
double kept_off(const Prepared& p, const std::vector<float>& open) {
    double sum = 0.0;
    for (std::size_t f = 0; f < p.world.ground_facets; ++f) {
        sum += double(p.world.facets.area[f]) * (1.0 - double(open[f]));
    }
    return sum;
}

}  // namespace

TEST_CASE("a roof keeps the rain off its own area of ground, a net its cover of it",
          "[scenes][rain]") {
    struct Case {
        const char* sheet;
        double kept;  // share of 100 m²
    };
    for (const auto& [sheet, kept] :
         {Case{"", 1.0}, Case{"cover = 0.65", 0.65},
          Case{"see_through = true\ntransmittance = \"clear.csv\"", 1.0}}) {
        const ScratchFolder folder("rain");
        write_text(folder.path / "clear.csv", "wavelength_um,value\n0.3,1.0\n20,1.0\n");
        const Prepared p = prepared_of({.sheet = sheet}, folder.path);
        const std::vector<float> open = open_above(p.world, p.scene.materials, p.weather);
        CAPTURE(sheet);
        REQUIRE(open.size() == p.world.facets.size());
        // 16 points a facet of a metre: 40 m of edge, each facet there to a sixteenth.
        CHECK(kept_off(p, open) == Approx(100.0 * kept).margin(2.5));
        for (std::size_t f = 0; f < p.world.facets.size(); ++f) {
            const double away = double(p.world.facets.centroid[f].head<2>().cwiseAbs().maxCoeff());
            if (f >= p.world.ground_facets) {
                const bool up = p.world.facets.normal[f].z() > 0.0f;
                CHECK(open[f] == (up ? 1.0f : 0.0f));
            } else if (away < 4.0) {
                CHECK(open[f] == Approx(1.0 - kept));
            } else if (away > 6.0 && away < 14.0) {
                CHECK(open[f] == 1.0f);
            }
        }
    }
}

TEST_CASE("no ray is cast where no rain falls", "[scenes][rain][by_degenerate]") {
    const ScratchFolder folder("no-rain");
    over_plain::write_scene(folder.path, {.mesh = over_plain::level_square(4)});
    const Prepared p = prepare(read_scene(folder.path / "scene.toml"));
    CHECK(open_above(p.world, p.scene.materials, p.weather).empty());
    CHECK(rain_note(p.world, p.scene.materials, p.weather, {}).empty());
}

// Snow of 2 mm/h from 19:00 (none) and 20:00 on to midnight, straight between: 1 + 8 = 9 mm lie in
// the open and on the sheet, 0.35 of it under a net of cover 0.65, none under a roof.
TEST_CASE("snow lies in the open and on a roof, not under it nor in flight", "[scenes][rain]") {
    struct Case {
        const char *sheet, *object;
        double above, below;  // [mm]
    };
    for (const auto& [sheet, object, above, below] :
         {Case{"", "", 9.0, 0.0}, Case{"cover = 0.65", "", 9.0, 0.35 * 9.0},
          Case{"", "airspeed_m_s = 100.0\n", 0.0, 0.0}}) {
        const ScratchFolder folder("snow");
        const Prepared p =
            prepared_of({.sheet = std::string("store = { capacity_mm = 2.0 }\n") + sheet,
                         .object = object,
                         .air = 265.0},
                        folder.path);
        Progress silent(ProgressStyle::silent);
        const SpanResult result = solve_scene(Stages(p), silent);
        std::vector<double> frost(p.world.facets.size(), 0.0);
        for (const HeatState::Point& point : result.end.point) {
            frost[point.facet] = point.standing.frost;
        }
        CAPTURE(sheet, object);
        for (std::size_t f = 0; f < frost.size(); ++f) {
            const double away = double(p.world.facets.centroid[f].head<2>().cwiseAbs().maxCoeff());
            const bool ground = f < p.world.ground_facets;
            CAPTURE(f, away, ground);
            if (!ground && p.world.facets.normal[f].z() > 0.0f) {
                CHECK(frost[f] == Approx(above).margin(0.3));  // it sublimates a little
            } else if (ground && away < 4.0) {
                CHECK(frost[f] == Approx(below).margin(0.3));
            } else if (ground && away > 6.0 && away < 14.0) {
                CHECK(frost[f] == Approx(9.0).margin(0.3));
            }
        }
        std::string reported;
        for (const std::string& note : result.notes) reported += note + "\n";
        CHECK_THAT(reported, Catch::Contains("rain and snow fall vertically"));
        CHECK((reported.find("in flight and without rain or snow") != std::string::npos) ==
              (*object != '\0'));
    }
}
