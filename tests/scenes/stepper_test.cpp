#include "scenes/job/run/stepper.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/heat.hpp"
#include "tests/support/crate.hpp"
#include "tests/support/slope_scene.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// A box of thin sheet on a plain part of the small scene, with a way as reported.
Scene crate_scene(const ScratchFolder& folder, const std::string& way) {
    write_text(folder.path / "crate.obj", crate_mesh);
    std::string text = small_scene();
    text = with(text, "radius_m = 4000.0", "radius_m = 800.0");
    text = with(text, "place_m = [2000.0, 1100.0]", "place_m = [-100.0, -100.0]");
    text = with(text, "height_above_ground_m = 450.0", "height_above_ground_m = 30.0");
    text = with(text, "look_at_m = [0.0, 0.0]", "look_at_m = [-50.0, -50.0]");
    write_text(folder.path / "scene.toml", text + crate_object + R"(trajectory = "road"
[[trajectory]]
name = "road"
)" + way);
    return read_scene(folder.path / "scene.toml");
}

const std::string goes_at_ten =
    R"(waypoints_m = [[-50.0, -50.0, 0.0], [-50.0, -50.0, 0.0], [10.0, -50.0, 0.0], [10.0, -50.0, 0.0]]
times_s = [0.0, 36000.0, 36060.0, 86400.0]
)";
/// The same way, and so the same fine ground along it, days behind the span.
const std::string stays = goes_at_ten + "start = 2026-07-18T00:00:00-04:00\n";

std::string a_crate(const std::string& name, const std::string& stands) {
    return "[[object]]\nname = \"" + name + "\"\nmesh = \"crate.obj\"\nup = \"z\"\n" + stands;
}

/// Of an object's facets that look up, by area [K].
double lid(Stepper& scene, ObjectId object) {
    const FacetSet& facets = scene.prepared().world.facets;
    const std::vector<float> kelvin = scene.temperature();
    double sum = 0.0, area = 0.0;
    for (std::size_t f = scene.prepared().world.ground_facets; f < facets.size(); ++f) {
        if (facets.object[f] != object || facets.normal[f].z() < 0.9f) continue;
        sum += double{facets.area[f]} * double{kelvin[f]};
        area += double{facets.area[f]};
    }
    return sum / area;
}

Instant clock(const char* at) { return parse_instant(std::string("2026-07-15T") + at + "-04:00"); }

}  // namespace

TEST_CASE("a program that does what a trajectory does finds what a run finds",
          "[scenes][stepper]") {
    const ScratchFolder folder("stepper");
    const Prepared prepared = prepare(crate_scene(folder, goes_at_ten));
    Progress silent(ProgressStyle::silent);
    const SpanResult run = solve_scene(Stages(prepared), silent);

    const ScratchFolder other("stepper_other");
    Stepper scene(crate_scene(other, stays));
    REQUIRE(scene.prepared().world.surfaces().size() == run.temperature.facets);
    const auto worst = [&](const char* at) {
        scene.advance(clock(at));
        const std::vector<float> found = scene.temperature();
        const std::vector<float> expected = run.temperature.interpolate(clock(at));
        double sum = 0.0;
        for (std::size_t f = 0; f < found.size(); ++f) {
            sum += std::pow(double{found[f]} - double{expected[f]}, 2);
        }
        return std::sqrt(sum / double(found.size()));
    };
    // Kept instants of both: hours and half hours lie on steps of 20 minutes or between two.
    CHECK(worst("00:00:00") < 0.01);
    CHECK(worst("06:00:00") < 0.01);
    CHECK(worst("09:00:00") < 0.01);
    // It goes at ten for a minute: the nearest step to its middle is ten o'clock's.
    scene.advance(clock("10:00:30"));
    Eigen::Isometry3d there = scene.pose("crate");
    there.translation().x() += 60.0;
    scene.put("crate", {10.0, -50.0}, 90.0);
    CHECK((scene.pose("crate").translation() - there.translation()).head<2>().norm() < 1e-3);
    CHECK(worst("11:00:00") < 0.02);
    CHECK(worst("16:00:00") < 0.02);
    CHECK(worst("22:00:00") < 0.02);
}

TEST_CASE("a black plate that comes into the sun follows its exponential",
          "[scenes][stepper][by_comparison]") {
    const ScratchFolder folder("stepper_plate");
    write_text(folder.path / "crate.obj", crate_mesh);
    // 800 W/m² from the sun and nothing from the sky, in still air of 300 K for ever.
    std::string weather =
        "time,air_temperature_K,relative_humidity,wind_speed_m_s,direct_normal_W_m2,diffuse_W_m2\n";
    for (int h = 0; h <= 48; ++h) {
        weather +=
            fmt::format("2026-07-{:02}T{:02}:00:00-04:00,300,0.3,2,800,0\n", 14 + h / 24, h % 24);
    }
    write_text(folder.path / "weather.csv", weather);
    std::string text = with(with(with(small_scene(), "radius_m = 4000.0", "radius_m = 800.0"),
                                 "place_m = [2000.0, 1100.0]", "place_m = [-100.0, -100.0]"),
                            "height_above_ground_m = 450.0", "height_above_ground_m = 60.0");
    const std::string file = std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/weather.csv";
    text = with(text, file, (folder.path / "weather.csv").string());
    text = with(text, "start = 2026-07-15T00:00:00-04:00\nstep_s = 1200.0\nframe_every_s = 21600.0",
                "start = 2026-07-15T11:00:00-04:00\nduration_h = 4.0\nstep_s = 300.0\n"
                "spin_up = \"periodic\"");
    for (const char* material :
         {"grass", "forest", "asphalt", "concrete_wall", "glass", "painted_steel"}) {
        text = with(text, fmt::format("\"{}\"", material), "\"black\"");
    }
    // All is black, so that no light comes by ground and roof, and 5 mm of steel that neither
    // radiates nor loses heat inwards.
    text += R"([material.black]
albedo = 0.0
emissivity = 0.0
roughness_length_m = 0.01
bottom = { kind = "flux", value_W_m2 = 0.0 }
convection = { kind = "constant", value_W_m2K = 10.0 }
layers = [{ thickness_m = 0.005, conductivity_W_mK = 50.0, density_kg_m3 = 7800.0, heat_capacity_J_kgK = 500.0 }]
)";
    text += a_crate("plate", "place_m = [-50.0, -50.0]\nmaterial = \"black\"\n");
    text += a_crate("roof",
                    "trajectory = \"stays\"\nscale = 10.0\n"
                    "material = \"black\"\nlargest_edge_m = 10.0\n");
    text += R"([[trajectory]]
name = "stays"
waypoints_m = [[-50.0, -50.0, 10.0], [-50.0, -49.0, 10.0]]
times_s = [0.0, 1.0]
start = 2026-07-18T00:00:00-04:00
)";
    write_text(folder.path / "scene.toml", text);
    Stepper scene(read_scene(folder.path / "scene.toml"));
    const ObjectId plate{3};
    // Shaded since the morning: as warm as the air.
    scene.advance(parse_instant("2026-07-15T13:25:00-04:00"));
    CHECK(lid(scene, plate) == Approx(300.0).margin(0.1));
    // At noon (13:42 on that clock) the sun stands 90 - 36.32 + 21.5 degrees high (Meeus' low
    // precision sun: declination 21.5 in mid-July), 0.2 % less of it on the lid 15 minutes off.
    Eigen::Isometry3d away = scene.pose("roof");
    away.translation().y() += 300.0;
    scene.put("roof", away);
    const double absorbed = 800.0 * std::sin((90.0 - 36.32 + 21.5) * M_PI / 180.0);
    const double film = 10.0, capacity = 0.005 * 7800.0 * 500.0;
    for (const double minutes : {5.0, 15.0, 30.0}) {
        scene.advance(later(parse_instant("2026-07-15T13:25:00-04:00"), 60.0 * minutes));
        const double risen = absorbed / film * (1.0 - std::exp(-film * 60.0 * minutes / capacity));
        CAPTURE(minutes);
        CHECK(lid(scene, plate) - 300.0 == Approx(risen).epsilon(0.01).margin(0.1));
    }
    // Back in the shade it falls as it rose.
    const double warm = lid(scene, plate) - 300.0;
    away.translation().y() -= 300.0;
    scene.put("roof", away);
    scene.advance(later(scene.now(), 1200.0));
    CHECK(lid(scene, plate) - 300.0 ==
          Approx(warm * std::exp(-film * 1200.0 / capacity)).epsilon(0.01).margin(0.1));
}

TEST_CASE("pictures cost no solve, and show what was put where", "[scenes][stepper]") {
    const ScratchFolder folder("stepper_pictures");
    Stepper scene(crate_scene(folder, stays));
    scene.advance(clock("11:00:00"));
    const int solved = scene.steps_solved();
    Observer eye = scene.observer("east");
    const auto crate_pixels = [&](const Picture& picture) {
        double column = 0.0, count = 0.0;
        const auto& object = picture.frame["object"].pixel;
        for (std::size_t p = 0; p < object.size(); ++p) {
            if (object[p] < 3.0f) continue;
            column += double(p % std::size_t(picture.frame.width)) + 0.5;
            count += 1.0;
        }
        return std::pair{count, column / std::max(1.0, count)};
    };
    const auto [count, column] = crate_pixels(scene.picture("east", eye));
    REQUIRE(count > 4.0);
    // 10 m to the right of the line of sight (which runs north-east), 71 m away: by tan.
    Eigen::Isometry3d pose = scene.pose("crate");
    pose.translation() += Eigen::Vector3d(10.0, -10.0, 0.0) / std::sqrt(2.0);
    scene.put("crate", pose);
    const auto [still, aside] = crate_pixels(scene.picture("east", eye));
    CHECK(still > 4.0);
    const double range = (pose.translation() - eye.position).norm();
    const double focal = 32.0 / std::tan(12.0 * 3.14159265358979 / 180.0);
    CHECK(aside - column == Approx(focal * 10.0 / range).margin(1.5));
    CHECK(scene.steps_solved() == solved);
    // The same from there again, to the bit, on one thread.
    const Picture two = scene.picture("east", eye);
    set_thread_count(1);
    const Picture one = scene.picture("east", eye);
    set_thread_count(0);
    CHECK(one.frame["radiance.8-12"].pixel == two.frame["radiance.8-12"].pixel);
}

TEST_CASE("what a stepper cannot do is refused", "[scenes][stepper]") {
    const ScratchFolder folder("stepper_mistakes");
    Stepper scene(crate_scene(folder, stays));
    using Catch::Contains;
    CHECK_THROWS_WITH(scene.put("crete", Eigen::Isometry3d::Identity()),
                      Contains("crete") && Contains("did you mean 'crate'"));
    CHECK_THROWS_WITH(scene.put("crate", {1e6, 0.0}, 0.0), Contains("crate"));
    CHECK_THROWS_WITH(scene.observer("west"), Contains("no observer \"west\""));
    CHECK_THROWS_WITH(scene.advance(clock("00:00:00") - std::chrono::hours(1)),
                      Contains("before the present time"));
    CHECK_THROWS_WITH(scene.advance(clock("23:59:59") + std::chrono::hours(1)),
                      Contains("end of the span"));
    CHECK(scene.now() == clock("00:00:00"));
}

TEST_CASE("an observer below the ground or inside a building is refused", "[scenes][stepper]") {
    const ScratchFolder folder("stepper_eye");
    Stepper scene(crate_scene(folder, stays));
    const Observer eye = scene.observer(scene.prepared().scene.observers[0].name);
    const auto problem = [&](const Eigen::Vector3d& by) {
        Observer there = eye;
        there.position += by;
        try {
            scene.picture(eye.name, there);
        } catch (const InputError& error) {
            return error.mistakes().front().problem;
        }
        return std::string();
    };
    // It stands 30 m above the ground.
    CHECK(problem({0.0, 0.0, -31.0}).find("below the terrain") != std::string::npos);
    CHECK(problem({0.0, 0.0, -29.0}).empty());
}

TEST_CASE("a program places an object on the slope as the scene does",
          "[scenes][stepper][stance]") {
    const ScratchFolder folder("stepper_slope");
    write_text(folder.path / "crate.obj", slope_scene::box(3.0, 6.0, 2.0));
    Stepper scene(read_scene(slope_scene::written(
        folder.path, slope_scene::plane(20.0, 90.0),
        slope_scene::object("crate", "trajectory = \"road\"") +
            "[[trajectory]]\nname = \"road\"\nwaypoints_m = [[0.0, 0.0, 0.0], [0.0, 0.0, "
            "0.0]]\ntimes_s = [0.0, 3600.0]\n")));
    scene.put("crate", Eigen::Vector2d(5.0, 7.0), 90.0);  // down the slope
    const Eigen::Vector3d front = scene.pose("crate").linear().col(1);
    CHECK(std::asin(front.z()) * 180.0 / M_PI == Approx(-20.0).margin(0.1));
}
