#include "scenes/job/run/check_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/job/run/check_error.hpp"
#include "scenes/job/run/check_weights.hpp"
#include "scenes/job/run/frames.hpp"
#include "scenes/job/run/heat.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// A hall on concrete, seen from above, by facets of so many metres.
std::string yard(double edge) {
    const std::string text = with(small_scene(), R"([[building]])",
                                  fmt::format(R"([[ground]]
name = "yard"
material = "concrete"
rectangle_m = [53.0, -88.4, 240.0, 240.0, 0.0]
largest_edge_m = {}
[[building]])",
                                              edge));
    return with(
        with(with(text, "radius_m = 4000.0", "radius_m = 1500.0"),
             "place_m = [2000.0, 1100.0]\nheight_above_ground_m = 450.0\nlook_at_m = [0.0, 0.0]",
             "place_m = [203.0, 91.6]\nheight_above_ground_m = 260.0\nlook_at_m = [53.0, -88.4]"),
        "frame_every_s = 21600.0", "frame_every_s = 10800.0");
}

/// An observer of 20 x 10 pixels above the hall.
std::string near_eye(const std::string& name, const std::string& band) {
    return fmt::format(R"([[observer]]
name = "{}"
place_m = [203.0, 91.6]
height_above_ground_m = 260.0
look_at_m = [53.0, -88.4]
horizontal_fov_deg = 24.0
width = 20
height = 10
bands = ["{}"]
)",
                       name, band);
}

struct Solved {
    Prepared prepared;
    SpanResult result;
};
Solved solved(const ScratchFolder& folder, const std::string& text, int points) {
    write_text(folder.path / "scene.toml", text);
    Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    Progress silent(ProgressStyle::silent);
    SpanResult result = solve_scene(Stages(prepared), silent, {.check_points = points});
    return {std::move(prepared), std::move(result)};
}

/// The note of the check.
std::string note_of(const SpanResult& result) {
    const auto note = std::find_if(result.notes.begin(), result.notes.end(),
                                   [](const auto& text) { return text.starts_with(check_begins); });
    return note == result.notes.end() ? "" : *note;
}
double reported_rms(const SpanResult& result) {
    const std::string note = note_of(result);
    const std::size_t end = note.find(" K rms");
    REQUIRE(end != std::string::npos);
    return std::stod(note.substr(note.rfind(' ', end - 1) + 1));
}

/// [K] rms of apparent temperature over pixels and instants between pictures of two runs.
double apart(const Solved& one, const Solved& other, const ScratchFolder& folder) {
    Progress silent(ProgressStyle::silent);
    for (const auto& [name, of] : {std::pair{"one", &one}, std::pair{"other", &other}}) {
        std::filesystem::create_directories(folder.path / name / "frames");
        render_frames(Stages(of->prepared), of->result.temperature, folder.path / name, silent);
    }
    const char* const plane = "apparent_temperature.8-12";
    double squares = 0.0, count = 0.0;
    const ObserverInput& eye = one.prepared.scene.observers.front();
    for (const Instant when : eye.frames) {
        const std::string file = frame_base(eye.name, "8-12", when) + ".exr";
        const Frame a = read_exr(folder.path / "one" / file);
        const Frame b = read_exr(folder.path / "other" / file);
        for (std::size_t p = 0; p < a[plane].pixel.size(); ++p) {
            const double t = double{a[plane].pixel[p]}, u = double{b[plane].pixel[p]};
            if (!(t > 0.0) || !(u > 0.0)) continue;
            squares += (t - u) * (t - u);
            count += 1.0;
        }
    }
    return std::sqrt(squares / count);
}

}  // namespace

// The truth is the same yard by facets of 4 m and sixteen times the rays: a scene of its own, of
// which the points know nothing.
TEST_CASE("check points report the error of facets in pictures",
          "[scenes][check_points][by_variation]") {
    const ScratchFolder folder("check_points");
    const auto fine_rays = [](const std::string& text) {
        return with(text, "sky_rays = 32", "sky_rays = 512\nobject_sky_rays = 4096");
    };
    const Solved truth = solved(folder, fine_rays(yard(4.0)), 0);
    CHECK(note_of(truth.result).empty());
    const Solved coarse = solved(folder, yard(24.0), 512);
    const double reported = reported_rms(coarse.result), is = apart(coarse, truth, folder);
    INFO("reported " << reported << " K, is " << is << " K; " << note_of(coarse.result));
    CHECK(reported < 1.3 * is);
    CHECK(reported > is / 1.3);
}

// A run whose pictures are others finds the same temperatures: what was kept of one is the other's.
TEST_CASE("points change no temperature of a scene", "[scenes][check_points][by_degenerate]") {
    const ScratchFolder folder("check_points_apart");
    const bool wet = GENERATE(false, true);
    std::string text = yard(24.0);
    if (wet) {  // its facets are followed by themselves, and their light goes by their water
        text = with(text, "material = \"concrete\"", "material = \"soil_of_rain\"") + R"(
[material.soil_of_rain]
like = "bare_soil"
store = { capacity_mm = 2.0 }
evaporation = { kind = "resistance", minimum_s_m = 100.0, wetness = 0.0 }
)";
    }
    const Solved without = solved(folder, text, 0), with_them = solved(folder, text, 64);
    CAPTURE(wet, note_of(with_them.result));
    CHECK_FALSE(note_of(with_them.result).empty());
    CHECK(without.result.temperature.facets == with_them.result.temperature.facets);
    CHECK(without.result.temperature.kelvin == with_them.result.temperature.kelvin);
    CHECK(without.result.report.passes == with_them.result.report.passes);
    CHECK(without.result.report.points == with_them.result.report.points);
    CHECK(without.result.temperature.solved_as.empty());
    CHECK(with_them.result.temperature.solved_as.empty());
}

// Of a grey surface in a vacuum a camera sees emissivity times the change of temperature, in every
// band; pixels are those of all pictures on ground and buildings.
TEST_CASE("check points are weighted by pixels and apparent temperature",
          "[scenes][check_points][by_closed_form]") {
    const ScratchFolder folder("check_weights");
    std::string text = small_scene() + R"(
[atmosphere]
profile = "vacuum"
[material.grey]
reflectance = "grey.csv"
like = "grass"
)" + near_eye("close", "8-12") +
                       "frames = [\"2026-07-15T12:00:00-04:00\"]\n" + near_eye("eye", "visible");
    text = with(text, "material = \"grass\"", "material = \"grey\"");
    write_text(folder.path / "grey.csv", "wavelength_um,reflectance\n0.3,0.2\n20,0.2\n");
    write_text(folder.path / "scene.toml", text);
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    const Stages stages(prepared);
    const CheckPoints points = check_points(stages, {}, 200);
    REQUIRE(points.point.size() > 150);
    std::vector<Instant> half_hours;
    for (int i = 0; i <= 48; ++i) {
        half_hours.push_back(parse_instant("2026-07-15T00:00:00-04:00") +
                             std::chrono::minutes(30 * i));
    }
    const CheckWeights weights = check_weights(prepared, points, half_hours);
    const std::size_t east_frames = prepared.sequences[0].frame.size();
    CHECK(weights.instant.size() == east_frames);  // noon is one of them
    double east = 0.0, close = 0.0, grey = 0.0;
    for (std::size_t k = 0; k < points.point.size(); ++k) {
        const CheckPoint& point = points.point[k];
        CHECK(point.observer < 2);  // a picture of sunlight shows no temperatures
        for (std::size_t a = 0; a < weights.instant.size(); ++a) {
            (point.observer == 0 ? east : close) += weights.pixels(a, point);
        }
        const FacetSet& surfaces = prepared.world.surfaces();
        const Material& material =
            prepared.scene.materials[surfaces.material[index(point.surface)]];
        if (material.name != "grey") continue;
        grey += 1.0;
        CHECK(weights.apparent[k] == Approx(0.8).epsilon(1e-6));
    }
    CHECK(grey > 20.0);
    // Both show hardly anything but ground and the hangar.
    CHECK(close == Approx(20.0 * 10.0).epsilon(0.1));
    CHECK(east > 0.5 * 64.0 * 48.0 * double(east_frames));
    CHECK(east <= 64.0 * 48.0 * double(east_frames) * 1.0001);
}
