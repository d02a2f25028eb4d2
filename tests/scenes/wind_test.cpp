#include "scenes/job/world/wind.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/world/build_world.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/sheet_scene.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather/wind_share.hpp"

using namespace diurna;
namespace over_plain = diurna::testing::over_plain;

namespace {

struct Built {
    Scene scene;
    World world;
};
Built built(const std::string& text) {
    const ScratchFolder folder("wind");
    write_text(folder.path / "scene.toml", text);
    Scene scene = read_scene(folder.path / "scene.toml");
    const Dem dem = read_dem(scene.terrain.elevation.file, scene.terrain.elevation.reading);
    World world = build_world(scene, dem);
    return {std::move(scene), std::move(world)};
}

}  // namespace

TEST_CASE("ground without buildings and objects has the wind as it is",
          "[scenes][wind][by_degenerate]") {
    std::string text = small_scene();
    const std::size_t from = text.find("[[building]]"), to = text.find("[weather]");
    text.erase(from, to - from);
    const Built b = built(text);
    CHECK(parts_in_wind(b.world, b.scene.materials, 10.0).empty());
}

TEST_CASE("a hangar takes wind from the ground about it and from nothing far off",
          "[scenes][wind]") {
    const Built b = built(small_scene());
    const auto parts = parts_in_wind(b.world, b.scene.materials, 10.0);
    REQUIRE(parts.size() == b.world.facets.size());
    const Eigen::Vector2f hangar(53.0f, -88.4f);
    double nearest = 1.0;
    for (std::size_t f = 0; f < parts.size(); ++f) {
        const double away = (b.world.facets.centroid[f].head<2>() - hangar).norm();
        if (f < b.world.ground_facets) {
            CHECK(parts[f].wind <= 1.0f);
            CHECK(parts[f].wind >= 1.0f / 3.0f);
            // 30 heights of 12 m and half the diagonal of 60 by 40 m.
            if (away > 30.0 * 13.5 + 37.0) REQUIRE(parts[f].wind == 1.0f);
            if (away < 60.0) nearest = std::min(nearest, double(parts[f].wind));
            continue;
        }
        // Walls and the roof have the wind of their height; the roof is 60 by 40 m.
        if (b.world.facets.normal[f].z() < 0.9f) continue;
        CHECK(parts[f].breadth == Approx(12.0).epsilon(1e-3));
        CHECK(parts[f].wind == Approx(wind_at_height(12.0, 10.0)).margin(0.03));
    }
    // Beside its longer side it hides up to half of all directions, and leaves them a third.
    CHECK(nearest > 0.6);
    CHECK(nearest < 0.8);
}

TEST_CASE("an object in flight takes its own wind and the air's recovery temperature",
          "[scenes][wind][flight]") {
    // A plate of 4 m, 1 mm of steel, black to nothing, alone with the air of 290 K at 1000 hPa:
    // at 200 m/s it settles at T (1 + r 0.2 M²), M = 200 / √(1.4 · 287.05 · 290) = 0.5859; Re =
    // 5e7, r = 0.99 · 0.892 + 0.01 · 0.843: 307.7 K. Standing it stays at 290 K.
    for (const double speed : {0.0, 200.0}) {
        const ScratchFolder folder("flight");
        over_plain::write_scene(
            folder.path,
            {.mesh = over_plain::level_square(4), .height = 5.0, .albedo = 1.0, .black = 0.0});
        std::string text = read_text(folder.path / "scene.toml");
        text = with(text, "height_above_ground_m = 5",
                    "airspeed_m_s = " + std::to_string(speed) + "\nheight_above_ground_m = 5");
        // The mesh's material, after the ground's.
        const std::string film = "convection = { kind = \"constant\", value_W_m2K = 10 }";
        const std::size_t at = text.rfind(film);
        REQUIRE(at != std::string::npos);
        text.replace(at, film.size(), "convection = { kind = \"plate\" }");
        write_text(folder.path / "scene.toml", text);
        const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
        Progress progress(ProgressStyle::silent);
        const SpanResult result = solve_scene(Stages(prepared), progress);
        const double sound_squared = 1.4 * 287.05 * 290.0;
        const double expected = 290.0 * (1.0 + 0.8916 * 0.2 * speed * speed / sound_squared);
        for (std::size_t i = 0; i < result.temperature.instant.size(); ++i) {
            for (std::size_t f = prepared.world.ground_facets; f < prepared.world.facets.size();
                 ++f) {
                CAPTURE(speed, i, f);
                CHECK(result.temperature.at(i)[f] == Approx(expected).margin(0.1));
            }
        }
    }
}

TEST_CASE("a plate's own size and the wind of its height reach its temperature",
          "[scenes][wind][film]") {
    // 4 by 4 m of sheet 5 m above a plain, 200 W/m2 in it, no radiation. Wind of 3 m/s at 10 m:
    // 3 ln(5/0.03) / ln(10/0.03) = 2.642 m/s over a mean chord of pi 16 m2 / 16 m (Cauchy), air of
    // 295 K (k 0.0256 W/mK, viscosity 1.56e-5 m2/s at 1000 hPa): Re 5.3e5, forced (0.037 Re^0.8 -
    // 160) 0.892 k / L = 9.1 W/m2K on each side (Incropera 7.2, tripped at 1e5); with free 3.8
    // above and 1.2 below (McAdams), cubes added, 9.3 + 9.1: 10.9 K. One metre in 3 m/s would
    // give 9.4 K.
    const ScratchFolder folder("size");
    over_plain::write_scene(folder.path, {.mesh = over_plain::level_square(4),
                                          .height = 5.0,
                                          .albedo = 1.0,
                                          .black = 0.0,
                                          .sheet = "internal_heat_W_m2 = 200.0"});
    std::string text = read_text(folder.path / "scene.toml");
    const std::string film = "convection = { kind = \"constant\", value_W_m2K = 10 }";
    text.replace(text.rfind(film), film.size(), "convection = { kind = \"plate\" }");
    write_text(folder.path / "scene.toml", text);
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    Progress progress(ProgressStyle::silent);
    const SpanResult result = solve_scene(Stages(prepared), progress);
    for (std::size_t f = prepared.world.ground_facets; f < prepared.world.facets.size(); ++f) {
        CAPTURE(f);
        CHECK(result.temperature.at(0)[f] == Approx(over_plain::air + 10.9).margin(0.4));
    }
}
