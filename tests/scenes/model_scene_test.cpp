#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "terrain/objects/models/models.hpp"
#include "tests/support/sheet_scene.hpp"

using namespace diurna;
namespace over_plain = diurna::testing::over_plain;

namespace {

/// A scene of a plain at 290 K under a sky of 330 W/m2, with these objects in place of the sheet.
std::filesystem::path scene_with(const std::filesystem::path& folder, const std::string& objects) {
    over_plain::write_scene(
        folder, {.mesh = over_plain::level_square(2), .longwave = 330.0, .ground_edge = 5.0});
    std::string text = read_text(folder / "scene.toml");
    const auto begin = text.find("[[object]]"), end = text.find("[material.");
    text.replace(begin, end - begin, objects);
    const auto put = [&](const std::string& old, const std::string& next) {
        text.replace(text.find(old), old.size(), next);
    };
    put("object_sky_rays = 1024", "object_sky_rays = 64");
    put("sky_rays = 1024", "sky_rays = 64");
    write_text(folder / "scene.toml", text);
    return folder / "scene.toml";
}

std::string object_of(const std::string& name, const std::string& model, double east,
                      const std::string& more = "") {
    return fmt::format(
        "[[object]]\nname = \"{}\"\nmodel = \"{}\"\nplace_m = [{}, 0.0]\ndetail = "
        "\"low\"\n{}",
        name, model, east, more);
}

std::string mistakes_of(const std::filesystem::path& file) {
    std::string all;
    try {
        read_scene(file);
    } catch (const InputError& error) {
        for (const Mistake& mistake : error.mistakes()) all += mistake.line() + "\n";
    }
    return all;
}

}  // namespace

TEST_CASE("part files name each part of their models, and no other", "[scenes][models]") {
    const ScratchFolder folder("models");
    for (const std::string& name : model_names()) {
        CAPTURE(name);
        std::set<std::string> at_low;
        for (const char* detail : {"low", "medium", "high"}) {
            const Scene scene = read_scene(
                scene_with(folder.path, fmt::format("[[object]]\nname = \"it\"\nmodel = "
                                                    "\"{}\"\ndetail = \"{}\"\nplace_m = [0, 0]\n",
                                                    name, detail)));
            const ObjectInput& object = scene.terrain.objects.at(0);
            std::set<std::string> parts, named, inside;
            for (const MeshFile::Part& part : object.mesh->part) parts.insert(part.node);
            for (const PartInput& part : object.target.part) {
                named.insert(part.name);
                if (!part.inside.empty()) inside.insert(part.inside);
            }
            CHECK(parts == named);
            for (const EnclosureInput& room : object.target.enclosure) {
                CHECK(inside.count(room.name) == 1);
            }
            CHECK(object.notes.empty());  // no triangle twice, none flat
            if (at_low.empty()) at_low = parts;
            CHECK(parts == at_low);
        }
    }
}

TEST_CASE("a scene says what a model is painted with and when it runs", "[scenes][models]") {
    const ScratchFolder folder("models");
    const Scene scene = read_scene(
        scene_with(folder.path, object_of("a", "truck", 0.0,
                                          "material = \"sand_paint\"\nrunning = [\"05:30-06:10 "
                                          "1.0\", \"06:10-07:00 0.3\"]\nnet_clearance_m = 0.4\n"
                                          "[object.parts]\ncanvas = \"wood\"\n") +
                                    object_of("b", "truck", 40.0)));
    const auto material = [&](const ObjectInput& object, const std::string& part) {
        for (std::size_t p = 0; p < object.mesh->part.size(); ++p) {
            if (object.mesh->part[p].node == part) return object.material[p];
        }
        return std::string("no such part");
    };
    const ObjectInput &a = scene.terrain.objects.at(0), &b = scene.terrain.objects.at(1);
    CHECK(material(a, "hood") == "sand_paint");
    CHECK(material(a, "canvas") == "wood");
    CHECK(material(a, "windows") == "glass");
    CHECK(material(a, "net") == "camouflage_net");
    CHECK(material(b, "hood") == "painted_sheet");
    CHECK(material(b, "canvas") == "canvas");
    CHECK(material(b, "net") == "no such part");
    const LumpInput &runs = a.target.lump.at(0), &off = b.target.lump.at(0);
    CHECK(runs.watts == 9000.0);
    REQUIRE(runs.hours.size() == 2);
    CHECK(runs.hours[0].from == 5.5 * 3600.0);
    CHECK(runs.hours[0].to == Approx(6.0 * 3600.0 + 600.0));
    CHECK(runs.hours[1].share == 0.3);
    CHECK(off.watts == 0.0);
    for (const PartInput& part : b.target.part) CHECK(part.watts_m2 == 0.0);
}

TEST_CASE("what a model cannot be combined with is reported", "[scenes][models]") {
    const ScratchFolder folder("models");
    const auto reported = [&](const std::string& more, const std::string& model = "truck") {
        return mistakes_of(scene_with(folder.path, object_of("a", model, 0.0, more)));
    };
    CHECK(reported("").empty());
    CHECK(reported("", "trukc").find("did you mean 'truck'") != std::string::npos);
    CHECK(reported("mesh = \"mesh.obj\"\n").find("cannot be combined with model") !=
          std::string::npos);
    CHECK(reported("up = \"y\"\n").find("cannot be combined with model") != std::string::npos);
    CHECK(reported("running = [\"5 to 6\"]\n").find("expected hours") != std::string::npos);
    CHECK(reported("running = [\"05:00-06:00\"]\n", "container").find("runs = true") !=
          std::string::npos);
    CHECK(reported("net_clearance_m = 40.0\n").find("net_clearance_m") != std::string::npos);
    const std::string file = mistakes_of(
        scene_with(folder.path,
                   "[[object]]\nname = \"a\"\nmesh = \"mesh.obj\"\nplace_m = [0, 0]\nmaterial = "
                   "\"sheet\"\nnet_clearance_m = 0.4\ndetail = \"low\"\n"));
    CHECK(file.find("detail: needs a model") != std::string::npos);
    CHECK(file.find("net_clearance_m: needs model instead of mesh") != std::string::npos);
}

TEST_CASE("a truck that runs is warm in front, a parked one as cold as the air",
          "[scenes][models]") {
    const ScratchFolder folder("models");
    Prepared prepared = prepare(read_scene(
        scene_with(folder.path, object_of("on", "truck", -40.0, "running = [\"18:00-06:00\"]\n") +
                                    object_of("off", "truck", 40.0))));
    Progress silent(ProgressStyle::silent);
    const SpanResult result = solve_scene(Stages(prepared), silent);
    CHECK(result.report.converged);
    CHECK(result.report.worst_energy_closure < 1e-8);
    const std::vector<float> all =
        result.temperature.interpolate(parse_instant("2026-03-20T03:00:00Z"));
    const auto kelvin = [&](const std::string& object, const std::string& part) {
        const FacetSet& facets = prepared.world.facets;
        double sum = 0.0, area = 0.0;
        for (std::size_t f = prepared.world.ground_facets; f < facets.size(); ++f) {
            const std::string& name = prepared.scene.materials[facets.material[f]].name;
            if (name.find(" of " + object + ": ") == std::string::npos ||
                name.find(" " + part) == std::string::npos) {
                continue;
            }
            sum += double(facets.area[f]) * double(all[f]);
            area += double(facets.area[f]);
        }
        REQUIRE(area > 0.0);
        return sum / area;
    };
    const double hood = kelvin("on", "hood"), cab = kelvin("on", "cab"),
                 idle = kelvin("off", "hood");
    CAPTURE(hood, cab, idle, kelvin("on", "exhaust"), kelvin("off", "cab"));
    CHECK(hood > cab + 5.0);
    CHECK(hood < 290.0 + 90.0);  // the engine itself has no more than 9000 W / 100 W/K
    CHECK(kelvin("on", "exhaust") > hood + 20.0);
    for (const char* part : {"hood", "cab", "canvas", "wheels", "exhaust", "bed"}) {
        CAPTURE(part, kelvin("off", part));
        CHECK(kelvin("off", part) == Approx(290.0).margin(5.0));
        CHECK(kelvin("off", part) < 290.0);  // the sky is colder than the air
    }
}

// The engine starts and stops within steps of the span, and the air grows warmer day by day, so
// that a day before the span is solved first and the span from its end.
TEST_CASE("engines that run for part of the day settle", "[scenes][models]") {
    // What rough marches leave of a generator's heat must not pass for a change of its neighbours.
    const auto [model, hours, most_passes] =
        GENERATE(std::tuple("truck", "10:40-11:10", 8), std::tuple("generator", "06:00-18:00", 8));
    const ScratchFolder folder("models");
    const auto file = scene_with(
        folder.path, object_of("on", model, 0.0, fmt::format("running = [\"{}\"]\n", hours)));
    std::string weather =
        "time,air_temperature_K,relative_humidity,pressure_Pa,wind_speed_m_s,longwave_down_W_m2\n";
    for (int h = 0; h <= 24; ++h) {
        weather += fmt::format("2026-03-{:02}T{:02}:00:00Z,{},0.3,100000,3,330\n", 20 + h / 24,
                               h % 24, 286.0 + 0.3 * h);
    }
    write_text(folder.path / "weather.csv", weather);
    Prepared prepared = prepare(read_scene(file));
    Progress silent(ProgressStyle::silent);
    const SpanResult result = solve_scene(Stages(prepared), silent);
    CHECK(result.report.converged);
    CHECK(result.report.passes <= most_passes);
}
