#include "scenes/studies/sensitivity.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "materials/base/files.hpp"
#include "materials/base/units.hpp"
#include "tests/support/heated_plate.hpp"

using namespace diurna;

// Thin plates in a vacuum which nothing shines on: emissivity sigma T^4 = q, so that what each
// number does stands on paper.

namespace {

using Json = nlohmann::json;

/// diurna sensitivity, and its exit code; what it reports stands in FOLDER/out.txt.
int sensitivity(const ScratchFolder& folder, const std::string& options = "") {
    const std::string out = (folder.path / "out").string();
    return WEXITSTATUS(
        std::system(("'" DIURNA_BINARY "' sensitivity '" + (folder.path / "scene.toml").string() +
                     "' --out '" + out + "' " + options + " >'" + out + ".txt' 2>&1")
                        .c_str()));
}

Json answer(const ScratchFolder& folder) {
    return Json::parse(read_text(folder.path / "out" / "sensitivity.json"));
}

/// [K]
double balanced(double heat, double emissivity = 1.0) {
    return std::pow(heat / (emissivity * stefan_boltzmann), 0.25);
}

const std::string heat =
    R"({ key = "material.black.internal_heat_W_m2", low = 280.0, high = 320.0 })";

}  // namespace

TEST_CASE("a plate of scheduled heat on black surroundings: dT/dq = 1 / (4 sigma T^3)",
          "[scenes][sensitivity][by_variation][by_comparison]") {
    const ScratchFolder folder("sensitivity_slope");
    lay_heated_plate(folder, R"(
[[sensitivity]]
trajectories = 0
uncertain = [
    { key = "material.black.internal_heat_W_m2", low = 299.0, high = 301.0 },
    { key = "weather.changed.wind_factor", low = 0.9, high = 1.1 },
]
output = [
    { first = "ground", at_h = 12.0 },
    { first = "plate", second = "ground", figure = "contrast", at_h = 3.0 },
]
)");
    const int code = sensitivity(folder);
    const std::string reported = read_text(folder.path / "out.txt");
    INFO(reported);
    REQUIRE(code == 0);
    const Json json = answer(folder);
    CHECK(json["scenes"] == 4);
    const double slope = 1.0 / (4.0 * stefan_boltzmann * std::pow(balanced(300.0), 3));
    const Json& plain = json["outputs"][0];
    CHECK(plain["base"].get<double>() == Approx(balanced(300.0)).margin(2e-3));
    // Kept as 32-bit floats: 1.5e-5 K of the 0.28 K between both ends.
    CHECK(plain["uncertain"][0]["slope"].get<double>() == Approx(slope).epsilon(5e-4));
    CHECK(plain["plus_minus"].get<double>() == Approx(2.0 * slope / std::sqrt(12.0)).epsilon(5e-4));
    const Json& contrast = json["outputs"][1];
    CHECK(contrast["base"].get<double>() == Approx(balanced(200.0) - balanced(300.0)).margin(5e-3));
    CHECK(contrast["uncertain"][0]["slope"].get<double>() == Approx(-slope).epsilon(2e-3));
    // What has no part in it is reported, and is zero to the last digit.
    CHECK(plain["uncertain"][1]["slope"] == 0.0);
    CHECK(contrast["uncertain"][1]["slope"] == 0.0);
    CHECK(reported.find("wind_factor has no effect") != std::string::npos);
    CHECK(reported.find("internal_heat_W_m2 has no effect") == std::string::npos);
    CHECK(json["notes"].dump().find("wind_factor has no effect") != std::string::npos);
}

TEST_CASE("a crossover moves with a number as its schedule has it",
          "[scenes][sensitivity][by_events][by_variation]") {
    // The plate has 280 W/m2 36 minutes before it has 300, 320 36 minutes after; at noon it turns.
    const ScratchFolder folder("sensitivity_crossover");
    lay_heated_plate(folder, fmt::format(R"(
[[sensitivity]]
trajectories = 2
levels = 2
uncertain = [{}]
output = [
    {{ first = "plate", second = "ground", figure = "crossover" }},
    {{ first = "plate", second = "ground", figure = "crossover", number = 2 }},
    {{ first = "plate", second = "ground", figure = "crossover", number = 3 }},
]
)",
                                         heat));
    const int code = sensitivity(folder);
    const std::string reported = read_text(folder.path / "out.txt");
    INFO(reported);
    REQUIRE(code == 0);
    const Json json = answer(folder);
    CHECK(json["scenes"] == 2 + 2 * 2);
    for (int i = 0; i < 2; ++i) {
        const Json& one = json["outputs"][std::size_t(i)];
        CAPTURE(i);
        const double side = i == 0 ? 1.0 : -1.0;
        CHECK(one["unit"] == "h");
        CHECK(one["base"].get<double>() == Approx(12.0 - 3.0 * side).margin(0.002));
        const Json& number = one["uncertain"][0];
        CHECK(number["at_low"].get<double>() ==
              Approx(12.0 - 3.6 * side).margin(0.006));  // a step's parabola
        CHECK(number["slope"].get<double>() == Approx(0.03 * side).epsilon(0.01));
        CHECK(number["effect"]["mean"].get<double>() == Approx(1.2 * side).epsilon(0.01));
        CHECK(number["effect"]["mean_size"].get<double>() == Approx(1.2).epsilon(0.01));
        CHECK(number["effect"]["morris_sigma"].get<double>() < 1e-9);
    }
    CHECK(json["outputs"][2]["base"].is_null());
    CHECK(json["outputs"][2]["uncertain"][0]["slope"].is_null());
    CHECK(reported.find("no such crossover") != std::string::npos);
}

TEST_CASE("elementary effects of two numbers that act on each other are those of their quotient",
          "[scenes][sensitivity][by_variation]") {
    // T = (q / (e sigma))^(1/4) at the corners of a square: the effect of q is one of two, by e.
    const ScratchFolder folder("sensitivity_corners");
    lay_heated_plate(folder, R"(
[[sensitivity]]
trajectories = 6
levels = 2
uncertain = [
    { key = "material.black.internal_heat_W_m2", low = 200.0, high = 400.0 },
    { key = "material.black.emissivity", low = 0.5, high = 1.0 },
]
output = [{ first = "ground", at_h = 12.0 }]
)");
    const int code = sensitivity(folder);
    INFO(read_text(folder.path / "out.txt"));
    REQUIRE(code == 0);
    const Json json = answer(folder);
    const Json& numbers = json["outputs"][0]["uncertain"];
    const double by_heat[2] = {balanced(400.0, 0.5) - balanced(200.0, 0.5),
                               balanced(400.0) - balanced(200.0)};
    const double by_emissivity[2] = {balanced(200.0) - balanced(200.0, 0.5),
                                     balanced(400.0) - balanced(400.0, 0.5)};
    for (std::size_t u = 0; u < 2; ++u) {
        CAPTURE(u);
        const double* both = u == 0 ? by_heat : by_emissivity;
        const Json& effect = numbers[u]["effect"];
        CHECK(effect["count"] == 6);
        const double mean = effect["mean"].get<double>();
        CHECK(effect["mean_size"].get<double>() == Approx(std::abs(mean)));
        // k of six are the second: a whole number, neither none nor all with this seed.
        const double k = 6.0 * (mean - both[0]) / (both[1] - both[0]);
        CHECK(k == Approx(std::round(k)).margin(2e-3));
        CHECK(std::round(k) >= 1.0);
        CHECK(std::round(k) <= 5.0);
        CHECK(effect["morris_sigma"].get<double>() ==
              Approx(std::abs(both[1] - both[0]) * std::sqrt(k * (6.0 - k) / (6.0 * 5.0)))
                  .epsilon(1e-3));
        CHECK(numbers[u]["at_low"].get<double>() ==
              Approx(u == 0 ? balanced(200.0) : balanced(300.0, 0.5)).margin(3e-3));
    }
}

TEST_CASE("the same bytes on one thread and on two, and no file after bad input",
          "[scenes][sensitivity]") {
    const ScratchFolder folder("sensitivity_bytes");
    lay_heated_plate(folder, fmt::format(R"(
[[sensitivity]]
trajectories = 1
uncertain = [{}]
output = [
    {{ first = "plate", at_h = 9.3 }},
    {{ first = "plate", second = "ground", figure = "crossover" }},
    {{ first = "plate", second = "ground", figure = "contrast", at_h = 9.0, band = "3-5" }},
    {{ first = "plate", second = "ground", figure = "contrast", at_h = 9.0, band = "8-12" }},
]
)",
                                         heat));
    std::string before;
    for (const char* threads : {"--threads 1", "--threads 2"}) {
        std::filesystem::remove_all(folder.path / "out");
        REQUIRE(sensitivity(folder, threads) == 0);
        std::string all;
        for (const char* file : {"sensitivity.csv", "sensitivity.json", "sensitivity.svg"}) {
            all += read_text(folder.path / "out" / file);
        }
        CHECK(all.size() > 2000);
        // Only the contrasts differ in nothing but their band.
        const std::string csv = read_text(folder.path / "out/sensitivity.csv");
        CHECK(csv.starts_with("output,unit,key,low,high,at_base,plus_minus,"));
        CHECK(csv.find("morris_sigma") != std::string::npos);
        CHECK(csv.find("plate - ground crossover 1,") != std::string::npos);
        CHECK(csv.find("plate - ground at 9 h from drone in 3-5,") != std::string::npos);
        CHECK(csv.find("plate - ground at 9 h from drone in 8-12,") != std::string::npos);
        if (!before.empty()) CHECK(all == before);
        before = all;
    }
    std::filesystem::remove_all(folder.path / "out");
    const auto refused = [&](const std::string& keys, const std::string& words) {
        lay_heated_plate(folder, "\n[[sensitivity]]\n" + keys);
        CAPTURE(keys);
        CHECK(sensitivity(folder) == 2);
        const std::string reported = read_text(folder.path / "out.txt");
        INFO(reported);
        CHECK(reported.find(words) != std::string::npos);
        CHECK(reported.find("scene.toml:") != std::string::npos);
        CHECK(reported.find("heat balance") == std::string::npos);
        CHECK(!std::filesystem::exists(folder.path / "out"));
    };
    const std::string out = "output = [{ first = \"plate\", at_h = 9.0 }]\n";
    const std::string in = "uncertain = [" + heat + "]\n";
    refused(in, "output: missing");
    refused(out, "uncertain: missing");
    refused(in + "output = [{ first = \"plat\", at_h = 9.0 }]\n", "plate");
    refused(in + "output = [{ first = \"plate\", at_h = 29.0 }]\n", "span of 24 h");
    refused(in + "output = [{ first = \"plate\" }]\n", "at_h: missing");
    refused(in + "output = [{ first = \"plate\", at_h = 9.0, number = 2 }]\n", "unknown key");
    refused(in + "output = [{ first = \"plate\", second = \"plate\", figure = \"crossover\" }]\n",
            "must differ from first");
    refused(in + "output = [{ first = \"plate\", second = \"ground\", figure = \"crossover\", band "
                 "= \"0.5-0.6\" }]\n",
            "below 3 um");
    refused(in + "output = [{ first = \"grass\", at_h = 9.0 }]\n", "\"grass\" has no surface");
    refused(in + out + "levels = 3\n", "even");
    refused(out + "uncertain = [{ key = \"material.black.albedo\", low = 0.5, high = 0.1 }]\n",
            "above low");
    refused(out + "uncertain = [{ key = \"material.black.albedo\", low = 0.5, high = 1.5 }]\n",
            "found 1.5");
    refused(out + "uncertain = [{ key = \"material.black.albdo\", low = 0.5, high = 0.9 }]\n",
            "albedo");
    refused(out + "uncertain = [{ key = \"sweep.draw\", low = 1, high = 2 }]\n",
            "light or temperature");
    refused(out + "uncertain = [" + heat + ", " + heat + "]\n", "twice");
    refused(
        in + "output = [{ first = \"plate\", at_h = 9.0 }, { first = \"plate\", at_h = 9.0 }]\n",
        "two of the name \"plate at 9 h\"");
    lay_heated_plate(folder, "");
    CHECK(sensitivity(folder) == 2);
}
