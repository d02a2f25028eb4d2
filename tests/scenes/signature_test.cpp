#include "scenes/studies/signature.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/studies/detection.hpp"
#include "scenes/studies/signature_aspects.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;
using std::numbers::pi;

namespace {

constexpr double warm = 310.0, cold = 290.0;  // [K] of the object and of all else

/// A ball of latitudes and longitudes; `turns` corners around. Its outline has (sin x)/x of a
/// circle's area, x = 2π/turns.
std::string ball_mesh(double radius, int turns) {
    const int rings = turns / 2;
    std::string text = fmt::format("v 0 0 {}\nv 0 0 {}\n", 2.0 * radius, 0.0);
    for (int r = 1; r < rings; ++r) {
        const double polar = pi * r / rings;
        for (int t = 0; t < turns; ++t) {
            const double turn = 2.0 * pi * t / turns;
            text += fmt::format("v {} {} {}\n", radius * std::sin(polar) * std::cos(turn),
                                radius * std::sin(polar) * std::sin(turn),
                                radius * (1.0 + std::cos(polar)));
        }
    }
    const auto corner = [&](int r, int t) { return 3 + (r - 1) * turns + t % turns; };
    for (int t = 0; t < turns; ++t) {
        text += fmt::format("f 1 {} {}\n", corner(1, t), corner(1, t + 1));
        text += fmt::format("f 2 {} {}\n", corner(rings - 1, t + 1), corner(rings - 1, t));
        for (int r = 1; r + 1 < rings; ++r) {
            text += fmt::format("f {} {} {} {}\n", corner(r, t), corner(r + 1, t),
                                corner(r + 1, t + 1), corner(r, t + 1));
        }
    }
    return text;
}

/// A closed box about the origin in plan, from the height `from` to `to`.
std::string box_mesh(double x, double y, double from, double to) {
    std::string text;
    for (const double z : {from, to}) {
        text += fmt::format("v {0} {1} {2}\nv {3} {1} {2}\nv {3} {4} {2}\nv {0} {4} {2}\n",
                            -0.5 * x, -0.5 * y, z, 0.5 * x, 0.5 * y);
    }
    return text + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

/// The small scene in a vacuum, with an object of `emissivity` on black ground.
Scene scene_with(const ScratchFolder& folder, const std::string& mesh, double emissivity,
                 const std::string& more, double up = 0.0) {
    write_text(folder.path / "thing.obj", mesh);
    std::string text = small_scene();
    text = with(text, "radius_m = 4000.0", "radius_m = 800.0");
    text = with(text, "material = \"grass\"", "material = \"black\"");
    text = with(text, "[[terrain.rule]]\nmaterial = \"forest\"\nslope_deg = [7.0, 90.0]\n", "");
    text = with(text, "material = \"asphalt\"", "material = \"black\"");
    text = with(text, "place_m = [2000.0, 1100.0]", "place_m = [-100.0, -100.0]");
    text = with(text, "height_above_ground_m = 450.0", "height_above_ground_m = 30.0");
    text = with(text, "look_at_m = [0.0, 0.0]", "look_at_m = [-50.0, -50.0]");
    write_text(folder.path / "scene.toml",
               text + fmt::format(R"(
[atmosphere]
profile = "vacuum"
[material.black]
like = "asphalt"
emissivity = 1.0
albedo = 0.0
[material.paint]
like = "painted_sheet"
emissivity = {}
albedo = {}
[[object]]
name = "thing"
mesh = "thing.obj"
up = "z"
material = "paint"
place_m = [200.0, 200.0]
height_above_ground_m = {}
heading_deg = 0.0
{})",
                                  emissivity, 1.0 - emissivity, up, more));
    return read_scene(folder.path / "scene.toml");
}

constexpr const char* seen_by_night = R"([[signature]]
object = "thing"
bands = ["8-12"]
directions = 42
frames = ["2026-07-15T00:00:00-04:00"]
)";

/// Temperatures of the object and of all else.
TemperatureField two_temperatures(const Prepared& prepared, double object, double rest) {
    const FacetSet& surfaces = prepared.world.surfaces();
    TemperatureField field;
    field.instant = {prepared.scene.time.start};
    field.facets = surfaces.size();
    for (std::size_t f = 0; f < surfaces.size(); ++f) {
        const bool own =
            prepared.world.objects[static_cast<std::size_t>(surfaces.object[f])] == "thing";
        field.kelvin.push_back(static_cast<float>(own ? object : rest));
    }
    return field;
}

struct Studied {
    Prepared prepared;
    Stages stages;
    TemperatureField field;
    SignatureReport report;

    Studied(Scene scene, double object, double rest)
        : prepared(prepare(std::move(scene))),
          stages(prepared),
          field(two_temperatures(prepared, object, rest)) {
        Progress silent(ProgressStyle::silent);
        report = signature_of(stages, prepared.scene.signatures.front(), field, silent);
    }
};

double black_radiance(double kelvin) {
    return band_radiance(parse_band("8-12", bin_edges_um()), kelvin);
}

}  // namespace

TEST_CASE("directions of the aspect sphere are even", "[scenes][signature]") {
    for (const int count : {42, 162, 642}) {
        const std::vector<Eigen::Vector3d> ways = even_directions(count);
        REQUIRE(ways.size() == std::size_t(count));
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
        for (const Eigen::Vector3d& way : ways) {
            CHECK(way.norm() == Approx(1.0));
            sum += way;
            second += way * way.transpose();
        }
        // Of an icosahedron's symmetry, nothing of the first two orders is left.
        CHECK(sum.norm() < 1e-9);
        CHECK((second / count - Eigen::Matrix3d::Identity() / 3.0).norm() < 1e-9);
    }
}

TEST_CASE("a black ball has the intensity L pi r^2 in every direction",
          "[scenes][signature][by_comparison]") {
    const ScratchFolder folder("signature_ball");
    const double r = 2.0;
    const Studied studied(scene_with(folder, ball_mesh(r, 96), 1.0, seen_by_night, 3.0), warm,
                          cold);
    CHECK(studied.report.rows.size() + studied.report.below == 42);
    CHECK(studied.report.hidden == 0);
    for (const SignatureRow& row : studied.report.rows) {
        CAPTURE(row.aspect_deg, row.elevation_deg);
        CHECK(row.area == Approx(pi * r * r).epsilon(0.01));
        // Where ground ends behind the ball there is space: pixels of its rim are parted with the
        // mean of both backgrounds there, which leaves 1 % in two directions; 0.1 % elsewhere.
        const bool before_space = row.elevation_deg < 20.0;
        CHECK(row.intensity ==
              Approx(black_radiance(warm) * pi * r * r).epsilon(before_space ? 0.02 : 0.005));
        if (before_space) continue;
        CHECK(row.contrast ==
              Approx((black_radiance(warm) - black_radiance(cold)) * pi * r * r).epsilon(0.01));
    }
}

TEST_CASE("without air a ball has the same intensity from far as from near",
          "[scenes][signature]") {
    const ScratchFolder folder("signature_afar");
    const double r = 2.0;
    const Studied studied(scene_with(folder, ball_mesh(r, 96), 1.0,
                                     std::string(seen_by_night) + "range_m = 150.0\n", 3.0),
                          warm, cold);
    int seen = 0;
    for (const SignatureRow& row : studied.report.rows) {
        if (row.elevation_deg < 20.0) continue;
        CAPTURE(row.aspect_deg, row.elevation_deg);
        CHECK(row.intensity == Approx(black_radiance(warm) * pi * r * r).epsilon(0.01));
        ++seen;
    }
    CHECK(seen > 10);
}

TEST_CASE("a plate has the intensity L A cos, a box the sum of its faces",
          "[scenes][signature][by_comparison]") {
    const double x = GENERATE(3.0, 4.0), y = 4.0;
    const double height = x == 3.0 ? 0.01 : 4.0;  // a plate, a cube
    const ScratchFolder folder("signature_box");
    const Studied studied(scene_with(folder, box_mesh(x, y, 0.0, height), 1.0, seen_by_night, 3.0),
                          warm, cold);
    for (const SignatureRow& row : studied.report.rows) {
        if (row.elevation_deg < 20.0) continue;
        const double elevation = radians(row.elevation_deg), turn = radians(row.aspect_deg);
        const double level = std::cos(elevation);
        const double area =
            x * y * std::sin(elevation) +
            height * level * (y * std::abs(std::sin(turn)) + x * std::abs(std::cos(turn)));
        CAPTURE(x, row.aspect_deg, row.elevation_deg);
        CHECK(row.area == Approx(area).epsilon(0.01));
        CHECK(row.intensity == Approx(black_radiance(warm) * area).epsilon(0.01));
        CHECK(row.contrast ==
              Approx((black_radiance(warm) - black_radiance(cold)) * area).epsilon(0.015));
    }
}

TEST_CASE("in an isothermal furnace a grey ball is invisible", "[scenes][signature]") {
    const ScratchFolder folder("signature_furnace");
    // Without its floor it is a sheet, whose inner side is a facet, too; it stands in the ground.
    write_text(folder.path / "furnace.obj",
               with(box_mesh(30.0, 30.0, 0.0, 30.0), "f 1 4 3 2\n", ""));
    const Studied studied(
        scene_with(folder, ball_mesh(2.0, 48), 0.5, std::string(seen_by_night) + R"([[object]]
name = "furnace"
mesh = "furnace.obj"
up = "z"
material = "paint"
place_m = [200.0, 200.0]
height_above_ground_m = -5.0
)",
                   8.0),
        cold, cold);
    for (const SignatureRow& row : studied.report.rows) {
        CAPTURE(row.aspect_deg, row.elevation_deg);
        CHECK(std::abs(row.contrast) < 1e-3 * row.intensity);
        CHECK(row.intensity == Approx(black_radiance(cold) * pi * 4.0).epsilon(0.01));
    }
}

TEST_CASE("without air ranges go with size over what a task needs", "[scenes][detection]") {
    const ScratchFolder folder("detection_ball");
    const double r = 2.0;
    std::string camera = R"([[instrument]]
preset = "cooled_mwir"
band = "3-5"
[[detection]]
object = "thing"
frames = ["2026-07-15T00:00:00-04:00"]
range_m = [1.0, 100000.0]
)";
    Scene scene = scene_with(folder, ball_mesh(r, 96), 1.0, camera, 3.0);
    scene.observers.front().place = {150.0, 170.0};
    scene.observers.front().stands.metres = 60.0;
    const Prepared prepared = prepare(std::move(scene));
    const Stages stages(prepared);
    const DetectionInput& input = prepared.scene.detections.front();
    Progress silent(ProgressStyle::silent);
    const auto at = [&](double object) {
        return detection_of(stages, input, two_temperatures(prepared, object, cold), silent)
            .front();
    };
    const DetectionCurve curve = at(warm);
    CHECK(curve.target.transmittance == Approx(1.0));
    CHECK(curve.target.area == Approx(pi * r * r).epsilon(0.01));
    CHECK(curve.target.least_width == Approx(2.0 * r).epsilon(0.03));  // two pixels of 96
    CHECK(curve.target.difference == Approx(warm - cold).epsilon(0.005));
    CHECK(curve.target.contrast == Approx(warm - cold).epsilon(0.005));
    // 20 K show the finest bars that pixels allow: R = √A · finest / N50.
    const InstrumentInput& instrument = prepared.scene.instruments.front();
    const ObserverInput& observer = prepared.scene.observers.front();
    const double pixel =
        2.0 * std::tan(radians(0.5 * observer.horizontal_fov_deg)) / observer.width;
    CHECK(instrument.instrument.detector.pitch /
              focal_length_of(observer, instrument.instrument.detector.pitch) ==
          Approx(pixel));
    for (std::size_t t = 0; t < 3; ++t) {
        CAPTURE(tasks[t].name);
        CHECK(curve.johnson_range[t][0] ==
              Approx(std::sqrt(pi) * r * 0.5 / pixel / tasks[t].cycles_square).epsilon(0.01));
        CHECK(curve.metric_range[t][0] * tasks[t].v50 ==
              Approx(curve.metric_range[0][0] * tasks[0].v50).epsilon(1e-6));
    }
    // √C: a quarter of the contrast is half the range, except for what the eye no longer sees.
    const DetectionCurve faint = at(cold + 2.0), fainter = at(cold + 0.5);
    CHECK(fainter.metric_range[0][0] < 0.5 * faint.metric_range[0][0]);
    CHECK(fainter.metric_range[0][0] > 0.3 * faint.metric_range[0][0]);
    // Of what is as warm as all else nothing is made out.
    const DetectionCurve none = at(cold);
    CHECK(none.target.contrast < 1e-3);
    CHECK(none.metric_range[0][0] == 0.0);
}

TEST_CASE("mistakes of studies are reported with their place", "[scenes][signature]") {
    const ScratchFolder folder("signature_mistakes");
    const auto problem = [&](const std::string& more) {
        try {
            scene_with(folder, box_mesh(1, 1, 0, 1), 0.9, more);
        } catch (const InputError& error) {
            return std::string(error.mistakes().front().line());
        }
        return std::string();
    };
    const std::string study = "[[signature]]\nobject = \"thing\"\n";
    CHECK_THAT(problem(study), Catch::Contains("expected at least one band"));
    CHECK_THAT(problem(study + "bands = [\"8-12\"]\ndirections = 100\n"),
               Catch::Contains("expected 42, 162 or 642"));
    CHECK_THAT(problem(study + "bands = [\"8-12\"]\nname = \"../x\"\n"),
               Catch::Contains("is used in file names"));
    CHECK_THAT(problem("[[signature]]\nobject = \"thong\"\nbands = [\"8-12\"]\n"),
               Catch::Contains("thing"));
    CHECK_THAT(problem("[[detection]]\nobject = \"thing\"\n"), Catch::Contains("[[instrument]]"));
    const std::string camera = "[[instrument]]\npreset = \"cooled_mwir\"\nband = \"3-5\"\n";
    CHECK_THAT(problem(camera + "[[detection]]\nobject = \"thing\"\nprobabilities = [1.0]\n"),
               Catch::Contains("between 0 and 1"));
    CHECK(problem(camera + "[[detection]]\nobject = \"thing\"\n").empty());
}
