#include "scenes/studies/checked_studies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/studies/crossover_study.hpp"
#include "scenes/studies/study_solves.hpp"
#include "tests/support/heated_plate.hpp"

// Studies of a scene before anything is solved: what `diurna check` and `diurna plan` report.

using namespace diurna;

namespace {

const std::string pair = "\n[[crossover]]\nfirst = \"plate\"\nsecond = \"ground\"\n";

std::string sensitive(const std::string& uncertain) {
    return "\n[[sensitivity]]\nuncertain = [" + uncertain +
           "]\noutput = [{ first = \"plate\", at_h = 12.0 }]\n";
}

/// Mistakes of the check of a scene with these studies.
std::vector<std::string> found_by_check(const std::string& more,
                                        const std::vector<std::string>& settings = {}) {
    const ScratchFolder folder("checked_studies");
    lay_heated_plate(folder, more);
    const StudyRequest request{.scene = folder.path / "scene.toml", .settings = settings};
    std::vector<std::string> lines;
    try {
        check_studies(prepare(request.read()), request);
    } catch (const InputError& error) {
        for (const Mistake& one : error.mistakes()) lines.push_back(one.line());
    }
    return lines;
}

void check_one(const std::vector<std::string>& lines, const std::string& first,
               const std::string& second) {
    REQUIRE(lines.size() == 1);
    CAPTURE(lines[0]);
    CHECK(lines[0].find("scene.toml:") != std::string::npos);
    CHECK(lines[0].find(first) != std::string::npos);
    CHECK(lines[0].find(second) != std::string::npos);
}

}  // namespace

TEST_CASE("the check of a scene finds wrong keys and values of uncertain numbers",
          "[scenes][checked_studies]") {
    const auto crossover = [](const std::string& uncertain) {
        return found_by_check(pair + "uncertain = [" + uncertain + "]\n");
    };
    check_one(crossover("{ key = \"weather.changed.wind_facter\", one_sigma = 1.1 }"),
              "crossover.uncertain[0]", "did you mean 'wind_factor'?");
    check_one(crossover("{ key = \"terrain.material\", one_sigma = 1.1 }"),
              "with terrain.material=1.1: found 1.1", "expected a text in quotes");
    check_one(crossover("{ key = \"material.black.albedo\", one_sigma = 1.5 }"), "found 1.5",
              "expected a number from 0 to 1");
    check_one(crossover("{ key = \"material.blak.albedo\", one_sigma = 0.5 }"),
              "unknown material \"blak\"", "did you mean 'black'?");
    check_one(
        found_by_check(sensitive("{ key = \"material.grass.albeddo\", low = 0.1, high = 0.2 }")),
        "sensitivity.uncertain[0]", "did you mean 'albedo'?");
    check_one(
        found_by_check(sensitive("{ key = \"material.black.emissivity\", low = 0.9, high = 1.2 }")),
        "with material.black.emissivity=1.2", "expected a number from 0 to 1");
    check_one(
        found_by_check("\n[[uncertain]]\nkey = \"weather.changed.wind_facter\"\none_sigma = 1.1\n"),
        "uncertain", "did you mean");
    // All of them at once, each in one line.
    const auto two = crossover(
        "{ key = \"weather.chnged.wind_factor\", one_sigma = 1.1 }, "
        "{ key = \"material.black.albdo\", one_sigma = 0.1 }");
    CHECK(two.size() == 2);
    // A part of a material of the library is a number like others.
    CHECK(crossover("{ key = \"material.grass.layers.1.saturation\", one_sigma = 0.5 }").empty());
}

TEST_CASE("settings reach studies by the names that the program gives them",
          "[scenes][checked_studies]") {
    const ScratchFolder folder("named_studies");
    lay_heated_plate(folder,
                     pair + sensitive("{ key = \"material.black.albedo\", low = 0, high = 0.2 }"));
    const auto read = [&](const std::string& setting) {
        return read_scene(folder.path / "scene.toml", {setting});
    };
    CHECK(read("crossover.plate-ground.threshold_K=2.5").crossovers[0].threshold == 2.5);
    CHECK(read("crossover.threshold_K=3.5").crossovers[0].threshold == 3.5);
    CHECK(read("sensitivity.sensitivity.levels=6").sensitivities[0].levels == 6);
    CHECK_THROWS_WITH(
        read("crossover.plates.threshold_K=2.5"),
        Catch::Contains("unknown crossover \"plates\"") && Catch::Contains("0 plate-ground"));
    CHECK_THROWS_WITH(read("contrast.both.ring=2"),
                      Catch::Contains("no table [[contrast]] to be changed"));
}

TEST_CASE("the plan counts the solves of studies, and the terminal numbers them",
          "[scenes][checked_studies]") {
    const ScratchFolder folder("counted_solves");
    lay_heated_plate(folder,
                     pair + R"(bands = ["8-12"]
uncertain = [{ key = "material.black.internal_heat_W_m2", one_sigma = 320.0 }]
[[contrast]]
targets = ["plate"]
)" +
                         sensitive("{ key = \"material.black.albedo\", low = 0, high = 0.2 }, "
                                   "{ key = \"material.grass.albedo\", low = 0.1, high = 0.2 }"));
    const StudyRequest request{.scene = folder.path / "scene.toml"};
    const Prepared prepared = prepare(request.read());
    const auto solves = study_solves(prepared.scene);
    CHECK(solves_of(solves, "crossover") == 3);  // the scene, half the step, one number
    CHECK(solves_of(solves, "contrast") == 1);
    CHECK(solves_of(solves, "signature") == 0);
    const SensitivityInput& input = prepared.scene.sensitivities[0];
    REQUIRE(input.trajectories > 1);
    // The scene, both ends and the middle of two numbers, one of the screening.
    CHECK(solves_of(solves, "sensitivity") == 1 + 4 + 2 + 1);
    const std::string text = describe(solves, prepared.plan);
    CAPTURE(text);
    CHECK(text.find("diurna crossover") < text.find("3 solves"));
    CHECK(text.find("8 solves or more") != std::string::npos);
    // Their pictures are in the time: of a crossover the band at every step.
    CHECK(text.find("besides pictures") == std::string::npos);
    REQUIRE(solves[0].kind == "crossover");
    CHECK(solves[0].pictures > double(prepared.plan.steps.size()));

    std::vector<std::string> stages;
    StudyRequest asked{.scene = folder.path / "scene.toml"};
    asked.progress = ProgressTo([&](const std::string& stage, double share) {
        if (share == 1.0) stages.push_back(stage);
    });
    const StudyFindings found = crossover_study(asked);
    for (int number = 1; number <= 3; ++number) {
        const std::string wanted = fmt::format("solve {} of 3: heat balance", number);
        CAPTURE(wanted, stages);
        CHECK(std::count(stages.begin(), stages.end(), wanted) == 1);
    }
    // As a run does, the study reports how its heat balance starts.
    CHECK(std::any_of(found.notes.begin(), found.notes.end(),
                      [](const std::string& note) { return note.starts_with("start: "); }));
}

TEST_CASE("a pair that never crosses is reported with the warmer one and the nearest hour",
          "[scenes][checked_studies]") {
    // sigma T^4 = q: the plain has 150 W/m2, the plate 200 to 400 from 6 to 12 h: the plate is
    // always warmer, least where it has 200, most at noon.
    const ScratchFolder folder("never_crosses");
    lay_heated_plate(folder, pair + "bands = [\"8-12\"]\nrefined = false\n");
    StudyRequest asked{.scene = folder.path / "scene.toml",
                       .settings = {"material.black.internal_heat_W_m2=150"}};
    const StudyFindings found = crossover_study(asked);
    const std::string& text = found.finding[0].reported;
    CAPTURE(text);
    CHECK(text.find("no crossover: plate is warmer throughout; smallest difference") !=
          std::string::npos);
    const auto kelvin = [](double heat) { return std::pow(heat / 5.670374419e-8, 0.25); };
    const auto json = nlohmann::json::parse(found.finding[0].texts.json);
    const auto& band = json["bands"][0];
    CHECK(band["nearest_difference_K"].get<double>() ==
          Approx(kelvin(200.0) - kelvin(150.0)).margin(0.05));
    CHECK(band["warmer_throughout"] == "plate");
    CHECK(band["crossings"].empty());
    const double hour = std::stod(band["nearest_time"].get<std::string>().substr(11, 2));
    CHECK((hour < 7.0 || hour >= 17.0));  // not while the plate has more than 200 W/m2
    CHECK(json["times"] == "clock of the scene, UTC−04:00");
    // With more heat in the plain the other one.
    asked.settings = {"material.black.internal_heat_W_m2=500"};
    const auto other = nlohmann::json::parse(crossover_study(asked).finding[0].texts.json);
    CHECK(other["bands"][0]["warmer_throughout"] == "ground");
    CHECK(other["bands"][0]["nearest_difference_K"].get<double>() ==
          Approx(kelvin(400.0) - kelvin(500.0)).margin(0.1));
    CHECK(other["bands"][0]["nearest_time"].get<std::string>().substr(11, 2) == "12");
}
