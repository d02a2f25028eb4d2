#include "scenes/studies/crossover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/studies/crossover_files.hpp"
#include "tests/support/heated_plate.hpp"

using namespace diurna;

// When two things look equally warm: the joint of heat, air, picture and search for zeros. Black
// surfaces in a vacuum look as warm as they are, so that two sinusoids cross where they do on
// paper.

namespace {

constexpr double daily = 2.0 * std::numbers::pi / 86400.0, hour = 3600.0;

/// With a black plate of 30 m, seen from 60 m above.
std::string plate_on_plain(const std::string& more) {
    return black_plain(plate_below_drone("black", R"(["0.5-0.6", "8-12", "3-5"])") + more);
}

double plate_at(double t) { return 300.0 + 10.0 * std::cos(daily * (t - 13.0 * hour)); }
double plain_at(double t) { return 297.0 + 4.0 * std::cos(daily * (t - 15.0 * hour)); }

/// Every 600 s: the plate's, and all else's [K].
TemperatureField two_days(const Prepared& prepared) {
    const FacetSet& surfaces = prepared.world.surfaces();
    TemperatureField field;
    field.facets = surfaces.size();
    for (double t = 0.0; t <= 86400.0; t += 600.0) {
        field.instant.push_back(later(prepared.scene.time.start, t));
        for (std::size_t f = 0; f < surfaces.size(); ++f) {
            const auto object = static_cast<std::size_t>(surfaces.object[f]);
            const bool own = prepared.world.objects[object] == "plate";
            field.kelvin.push_back(static_cast<float>(own ? plate_at(t) : plain_at(t)));
        }
    }
    return field;
}

Scene scene_of_text(const ScratchFolder& folder, const std::string& text,
                    const std::vector<std::string>& settings = {}) {
    lay(folder, text);
    return read_scene(folder.path / "scene.toml", settings);
}

std::vector<Mistake> mistakes_of(const std::string& more) {
    const ScratchFolder folder("crossover_mistakes");
    try {
        scene_of_text(folder, plate_on_plain(more));
    } catch (const InputError& error) {
        return error.mistakes();
    }
    return {};
}

/// diurna crossover FILE, and its exit code.
int crossover(const std::filesystem::path& scene, const std::filesystem::path& out) {
    return WEXITSTATUS(
        std::system(("'" DIURNA_BINARY "' crossover '" + scene.string() + "' --out '" +
                     out.string() + "' >'" + out.string() + ".txt' 2>&1")
                        .c_str()));
}

}  // namespace

TEST_CASE("black plates cross when their sinusoids do", "[scenes][crossover][by_events]") {
    const ScratchFolder folder("crossover_sinusoids");
    const std::string text = plate_on_plain(R"(
[[crossover]]
first = "plate"
second = "ground"
refined = false
[[crossover]]
first = "plate"
second_pixels = [0, 0, 4, 32]
bands = ["8-12"]
refined = false
)");
    Study study(scene_of_text(folder, text), ProgressStyle::silent);
    check_crossovers(study.stages().scene(),
                     [](const std::vector<std::string>&) -> Scene { throw "none"; });
    const TemperatureField field = two_days(study.stages().scene());
    const CrossoverAnswer answer = crossovers_of(
        study, field, [](const std::vector<std::string>&) -> Scene { throw "none is asked for"; });
    REQUIRE(answer.report.size() == 2);
    REQUIRE(answer.report[0].band.size() == 2);  // the observer's beyond 3 um
    REQUIRE(answer.report[1].band.size() == 1);
    // 10 cos(wt - p) - 4 cos(wt - q) + 3 = R cos(wt - s) + 3.
    const double p = daily * 13.0 * hour, q = daily * 15.0 * hour;
    const double x = 10.0 * std::cos(p) - 4.0 * std::cos(q),
                 y = 10.0 * std::sin(p) - 4.0 * std::sin(q);
    const double r = std::hypot(x, y), s = std::atan2(y, x), half = std::acos(-3.0 / r);
    std::vector<double> wanted;
    for (const double angle : {s - half, s + half}) {
        wanted.push_back(std::fmod(angle / daily + 2.0 * 86400.0, 86400.0));
    }
    std::sort(wanted.begin(), wanted.end());
    for (const CrossoverReport& report : answer.report) {
        for (const CrossoverDay& day : report.band) {
            CAPTURE(day.band);
            REQUIRE(day.crossing.size() == 2);
            for (std::size_t i = 0; i < 2; ++i) {
                const TimedCrossing& one = day.crossing[i];
                // Straight between steps of 600 s: w^2 h^2 / 8 of the swing, 0.8 s of time.
                CHECK(std::abs(seconds_between(study.scene().time.start, one.when) - wanted[i]) <
                      2.0);
                const double slope = -r * daily * std::sin(daily * wanted[i] - s);
                CHECK(one.slope == Approx(slope).epsilon(0.01));
                CHECK(one.first_warmer_after == (slope > 0.0));
                CHECK(one.kind == ZeroCrossing::Kind::crosses);
            }
            for (std::size_t k = 0; k < day.instant.size(); k += 24) {
                CHECK(day.first[k] == Approx(plate_at(600.0 * double(k))).margin(2e-3));
                CHECK(day.second[k] == Approx(plain_at(600.0 * double(k))).margin(2e-3));
            }
            // |R cos x + 3| < 1: between acos(-2/R) and acos(-4/R), twice.
            const double lost = 2.0 * (std::acos(-4.0 / r) - std::acos(-2.0 / r)) / daily;
            CHECK(day.lost == Approx(lost).epsilon(0.002));
        }
    }
    CHECK(answer.report[0].first_pixels > 50);
    CHECK(answer.report[1].second_pixels == 4 * 32);
}

TEST_CASE("tables of crossovers are checked, with their place", "[scenes][crossover]") {
    const auto one = [](const std::string& keys, const std::string& reported) {
        const std::vector<Mistake> mistakes = mistakes_of("\n[[crossover]]\n" + keys);
        REQUIRE(mistakes.size() == 1);
        INFO(mistakes[0].line());
        CHECK(mistakes[0].line().find(reported) != std::string::npos);
    };
    one("first = \"plat\"\nsecond = \"ground\"\n", "plate");
    one("first = \"plate\"\nsecond = \"plate\"\n", "must differ from first");
    one("first = \"plate\"\nsecond_pixels = [40, 0, 10, 2]\n", "48 x 32 pixels");
    one("first = \"plate\"\nsecond = \"ground\"\nbands = [\"0.5-0.6\"]\n", "below 3 um");
    one("first = \"plate\"\nsecond = \"ground\"\nobserver = \"drohne\"\n", "drone");
    one("first = \"plate\"\nsecond = \"ground\"\n"
        "uncertain = [{ key = \"sweep.draw\", one_sigma = 1.0 }]\n",
        "light or temperature");
    // A region that no pixel is filled by, found before anything is solved.
    const ScratchFolder folder("crossover_unseen");
    lay(folder, plate_on_plain("\n[[crossover]]\nfirst = \"plate\"\nsecond = \"grass\"\n"));
    CHECK(crossover(folder.path / "scene.toml", folder.path / "out") == 2);
    CHECK(read_text(folder.path / "out.txt").find("no pixel of \"drone\" is filled by \"grass\"") !=
          std::string::npos);
    CHECK(read_text(folder.path / "out.txt").find("scene.toml:") != std::string::npos);
    CHECK(read_text(folder.path / "out.txt").find("second") != std::string::npos);
    CHECK(read_text(folder.path / "out.txt").find("heat balance") == std::string::npos);
    CHECK(!std::filesystem::exists(folder.path / "out"));
    lay(folder,
        plate_on_plain("\n[[crossover]]\nfirst = \"plate\"\nsecond = \"ground\"\nuncertain = "
                       "[{ key = \"weather.changed.wind\", one_sigma = 1.1 }]\n"));
    CHECK(crossover(folder.path / "scene.toml", folder.path / "out") == 2);
    const std::string reported = read_text(folder.path / "out.txt");
    INFO(reported);
    CHECK(reported.find("scene.toml:") != std::string::npos);
    CHECK(reported.find("wind_factor") != std::string::npos);
    CHECK(reported.find("heat balance") == std::string::npos);
    lay(folder, plate_on_plain(""));
    CHECK(crossover(folder.path / "scene.toml", folder.path / "out") == 2);
}

TEST_CASE(
    "a plate whose heat is scheduled crosses one whose heat is not, at the hour of its schedule",
    "[scenes][crossover][by_events]") {
    // Thin black plates in a vacuum, which nothing shines on: sigma T^4 = q. The plain has 300 W/m2
    // all day, the plate 200 to 400 from 6 to 12 h of the scene's clock and back to 200 at 18
    // h: equal at 9 and 15 h. With 320 in the plain, a standard deviation away, 36 minutes nearer
    // noon.
    const ScratchFolder folder("crossover_schedule");
    lay_heated_plate(folder, R"(
[[crossover]]
name = "plates"
first = "plate"
second = "ground"
bands = ["8-12"]
uncertain = [{ key = "material.black.internal_heat_W_m2", one_sigma = 320.0 }]
)");
    const int code = crossover(folder.path / "scene.toml", folder.path / "out");
    INFO(read_text(folder.path / "out.txt"));
    REQUIRE(code == 0);
    const auto json = nlohmann::json::parse(read_text(folder.path / "out" / "plates.json"));
    const auto& crossings = json["bands"][0]["crossings"];
    REQUIRE(crossings.size() == 2);
    const Instant midnight = parse_instant("2026-07-15T00:00:00-04:00");
    const std::vector<double> clock{9.0 * hour, 15.0 * hour}, shift{2160.0, -2160.0};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto& one = crossings[i];
        const double at = seconds_between(midnight, parse_instant(one["time"].get<std::string>()));
        // 10 J/m2K behind 4 sigma T^3 of 5.4 W/m2K lag 2 s.
        CHECK(at == Approx(clock[i] + 2.0).margin(4.0));
        CHECK(std::abs(one["refined_shift_s"].get<double>()) < 15.0);
        CHECK(one["shift_s"]["material.black.internal_heat_W_m2"].get<double>() ==
              Approx(shift[i]).margin(20.0));
        CHECK(one["sigma_s"].get<double>() == Approx(2160.0).margin(20.0));
        CHECK(one["warmer_after"] == (i == 0 ? "plate" : "ground"));
        CHECK(one["gone_with"].empty());
    }
}

TEST_CASE("without uncertain numbers a crossing has no standard deviation", "[scenes][crossover]") {
    const Instant noon = parse_instant("2026-07-15T12:00:00-04:00");
    TimedCrossing crossing{.when = noon, .slope = 1e-3, .refined = {}, .shift = {}};
    CrossoverReport report;
    report.band.push_back({.band = "8-12",
                           .instant = {noon},
                           .first = {300.0},
                           .second = {300.0},
                           .crossing = {crossing}});
    CrossoverInput input;
    input.first.name = "plate";
    input.second.name = "ground";
    CHECK(crossover_csv(input, report, 0.0).find(",ground,3.6,0,,\n") != std::string::npos);
    const auto one = [&] {
        return nlohmann::json::parse(
            crossover_json(input, "drone", report, {}, 0.0))["bands"][0]["crossings"][0];
    };
    CHECK(one()["sigma_s"].is_null());
    input.uncertain.push_back({.key = "material.black.albedo", .one_sigma = 0.2, .where = {}});
    report.band[0].crossing[0].shift = {60.0};
    report.band[0].crossing[0].sigma = 60.0;
    CHECK(one()["sigma_s"] == 60.0);
}
