#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/radiation/planck.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// 400 m of the small scene's runway from above, at noon and at midnight.
std::string runway_scene() {
    std::string text = small_scene();
    for (const auto& [from, to] :
         {std::pair{"radius_m = 4000.0", "radius_m = 500.0"},
          {"frame_every_s = 21600.0", "frame_every_s = 43200.0"},
          {"[2000.0, 1100.0]", "[0.0, 300.0]"},
          {"look_at_m = [0.0, 0.0]", "azimuth_deg = 45.0\nelevation_deg = -90.0"},
          {"place_m = [0.0, 300.0]", "place_m = [150.0, 150.0]"},
          {"horizontal_fov_deg = 24.0", "projection = \"orthographic\"\npicture_width_m = 40.0"},
          {"width = 64\n", "width = 40\n"},
          {"height = 48", "height = 200"}}) {
        text = with(text, from, to);
    }
    return text;
}

std::string textured(const std::string& table) {
    return with(runway_scene(), "material = \"asphalt\"",
                "material = \"asphalt\"\ntexture = \"t\"") +
           "[[texture]]\nname = \"t\"\n" + table;
}

/// A material of one albedo in place of the runway's.
std::string with_runway(const std::string& keys) {
    return with(runway_scene(), "\"asphalt\"", "\"surface\"") +
           "[material.surface]\nlike = \"asphalt\"\n" + keys;
}

/// apparent_temperature.8-12 of the frames at midnight and noon, local time; notes of the run.
struct Pictures {
    std::vector<float> night, noon, noon_radiance;
    std::vector<std::string> notes;
    JobReport report;
};
Pictures pictures_of(const std::string& text) {
    const ScratchFolder folder("textured");
    write_text(folder.path / "scene.toml", text);
    Pictures found;
    found.report = run_job(read_scene(folder.path / "scene.toml", {}, true),
                           {.out = folder.path / "out", .settings = {}});
    found.notes = found.report.notes;
    const auto frame = [&](const char* time) {
        return read_exr(folder.path / "out/frames" /
                        (std::string("east_8-12_20260715T") + time + ".exr"));
    };
    found.night = frame("040000Z")["apparent_temperature.8-12"].pixel;
    found.noon = frame("160000Z")["apparent_temperature.8-12"].pixel;
    found.noon_radiance = frame("160000Z")["radiance.8-12"].pixel;
    return found;
}

double mean(const std::vector<float>& a) {
    double sum = 0.0;
    for (const float v : a) sum += double{v} / double(a.size());
    return sum;
}
/// Mean and standard deviation of a − b.
std::array<double, 2> difference(const std::vector<float>& a, const std::vector<float>& b) {
    REQUIRE(a.size() == b.size());
    double sum = 0.0, square = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double d = double{a[i]} - double{b[i]};
        sum += d / double(a.size());
        square += d * d / double(a.size());
    }
    return {sum, std::sqrt(square - sum * sum)};
}

std::vector<Mistake> mistakes_of(const std::string& text) {
    const ScratchFolder folder("textured");
    write_text(folder.path / "scene.toml", text);
    write_text(folder.path / "grid.asc",
               "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 1\n1 255\n");
    try {
        prepare(read_scene(folder.path / "scene.toml"));
    } catch (const InputError& error) {
        return error.mistakes();
    }
    return {};
}

}  // namespace

// The picture's deviation follows from two solves of plain runways, 0.08 and 0.16 of albedo, and
// from the texture's 0.02: no more than the 3 % that the aperture of a sample (0.25 m of 4) and the
// cut at three deviations take, and 5 % of sampling (8000 m2 hold some 300 patches).
TEST_CASE("clutter of albedo appears as its deviation of apparent temperature",
          "[scenes][texture][thermal]") {
    const Pictures dark = pictures_of(with_runway("albedo = 0.08")),
                   middle = pictures_of(with_runway("albedo = 0.12")),
                   light = pictures_of(with_runway("albedo = 0.16")),
                   clutter =
                       pictures_of(textured("mean = 0.12\nstd = 0.02\ncorrelation_length_m = 2.0\n"
                                            "covariance = \"gaussian\"\nseed = 3\n"));
    const double noon = (mean(light.noon) - mean(dark.noon)) / 0.08,
                 night = (mean(light.night) - mean(dark.night)) / 0.08;
    const auto [noon_bias, noon_spread] = difference(clutter.noon, middle.noon);
    const auto [night_bias, night_spread] = difference(clutter.night, middle.night);
    CAPTURE(noon, night, noon_bias, night_bias);
    CHECK(noon < -15.0);  // K per unit of albedo
    CHECK(noon_spread == Approx(0.02 * std::abs(noon)).epsilon(0.08));
    // Asphalt keeps 0.4 of it to midnight: solved, not painted on.
    CHECK(night_spread == Approx(0.02 * std::abs(night)).epsilon(0.08));
    CHECK(night_spread < 0.5 * noon_spread);
    CHECK(std::abs(noon_bias) < 0.1);
    CHECK(clutter.notes.front().find("texture \"t\": ") == 0);
}

// Two levels 0.3 of albedo or 0.2 of emissivity apart, everywhere half and half (texels far below a
// sample), against a solve of the albedo between: what the straight line between two solutions
// costs.
TEST_CASE("between two levels a parameter's radiance is nearly straight",
          "[scenes][texture][thermal]") {
    const ScratchFolder folder("board");
    write_text(folder.path / "board.asc",
               "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 1\n1 0\n");
    const std::string what = GENERATE("albedo", "emissivity");
    const double low = what == "albedo" ? 0.05 : 0.78;
    const auto laid = [&](double scale, double offset) {
        return pictures_of(
            textured("what = \"" + what + "\"\nfile = \"" + (folder.path / "board.asc").string() +
                     "\"\nmetres_per_texel = 0.01\nrepeat = true\nlevels = 2\n" +
                     "scale = " + std::to_string(scale) + "\noffset = " + std::to_string(offset)));
    };
    const double apart = what == "albedo" ? 0.3 : 0.2;
    const Pictures halves = laid(apart, low), whole = laid(0.0, low + 0.5 * apart);
    CHECK(halves.report.plan.facets > whole.report.plan.facets);  // that one is plain again
    const double noon = difference(halves.noon, whole.noon)[0],
                 night = difference(halves.night, whole.night)[0];
    CAPTURE(what, noon, night);
    // Measured at noon and midnight: albedo 0.009 and -0.053 K, emissivity 0.068 and 0.037 K.
    CHECK(std::abs(noon) < 0.08);
    CHECK(std::abs(night) < 0.08);
}

TEST_CASE("a mixture of a material with itself is solved as that material",
          "[scenes][texture][thermal][by_degenerate]") {
    const Pictures plain = pictures_of(runway_scene());
    const Pictures mixed =
        pictures_of(textured("what = \"mixture\"\nbetween = [\"asphalt\", \"asphalt\"]\n"
                             "std = 0.2\ncorrelation_length_m = 3.0"));
    for (std::size_t p = 0; p < plain.noon.size(); ++p) {
        REQUIRE(double{mixed.noon[p]} == Approx(double{plain.noon[p]}).margin(1e-3));
        REQUIRE(double{mixed.night[p]} == Approx(double{plain.night[p]}).margin(1e-3));
    }
    CHECK(mixed.report.plan.facets > plain.report.plan.facets);
    CHECK(mixed.report.solve.converged);
    CHECK(mixed.report.solve.worst_energy_closure < 1e-9);
}

TEST_CASE("every mistake in a texture is one clear line", "[scenes][texture][scene_file]") {
    const std::string good = "std = 0.02\ncorrelation_length_m = 2.0\n";
    REQUIRE(mistakes_of(textured(good)).empty());
    const auto problem = [](const std::string& text) {
        const auto found = mistakes_of(text);
        REQUIRE_FALSE(found.empty());
        for (const Mistake& one : found) UNSCOPED_INFO(one.line());
        CHECK(found.size() == 1);
        CHECK(found[0].line().find('\n') == std::string::npos);
        CHECK(found[0].where.find("scene.toml:") != std::string::npos);
        return found[0].line();
    };
    const auto has = [](const std::string& line, const std::string& part) {
        CAPTURE(line, part);
        CHECK(line.find(part) != std::string::npos);
    };
    has(problem(with(textured(good), "texture = \"t\"", "texture = \"tt\"")),
        "unknown texture \"tt\" in [[texture]] (did you mean 't'?)");
    has(problem(textured(good + "sdt = 1")), "unknown key");
    has(problem(textured("std = 0.02")), "correlation_length_m: missing");
    has(problem(textured("what = \"colour\"\n" + good)), "texture.what");
    has(problem(textured("mean = 0.5\nstd = 0.3\ncorrelation_length_m = 2.0")),
        "found 0.3 about a mean of 0.5");
    has(problem(textured("std = 0.2\ncorrelation_length_m = 2.0")),
        "on material \"asphalt\": more than 2.5 % of values would be cut off");
    has(problem(textured("what = \"mixture\"\n" + good)), "expected the names of two materials");
    has(problem(textured("what = \"mixture\"\nbetween = [\"grass\", \"gras\"]\n" + good)),
        "no material \"gras\" (did you mean 'grass'?)");
    has(problem(textured("file = \"none.png\"")), "no such file: ");
    has(problem(textured("file = \"grid.asc\"\nmetres_per_texel = 1.0")),
        "gives values from 0 to 255, expected 0 to 1");
    has(problem(textured("file = \"grid.asc\"\nscale = 0.0039")),
        "metres_per_texel: missing, and grid.asc has no georeference");
    has(problem(textured("file = \"grid.asc\"\nscale = 0.0039\nplace_m = [0.0, 0.0]")),
        "metres_per_texel: missing");
    has(problem(textured("file = \"grid.asc\"\nchannel = 3\nmetres_per_texel = 1.0")),
        "has 1 channel, expected at least 3");
    has(problem(textured(good) + "[[texture]]\nname = \"t\"\n" + good),
        "a second texture named \"t\"");
}

// Ground that leaves its material to the rules is no object of its own, but has its own texture.
TEST_CASE("textures lie on ground, polygons, objects' parts and materials", "[scenes][texture]") {
    const ScratchFolder folder("textured");
    const std::string tables =
        "[[texture]]\nname = \"wide\"\nstd = 0.02\ncorrelation_length_m = 50.0\n"
        "[[texture]]\nname = \"near\"\nstd = 0.03\ncorrelation_length_m = 5.0\n"
        "[[texture]]\nname = \"rust\"\nwhat = \"emissivity\"\nstd = 0.02\nmean = 0.8\n"
        "correlation_length_m = 1.0\n"
        "[material.old_wall]\nlike = \"concrete_wall\"\ntexture = \"rust\"\n"
        "[[ground]]\nname = \"yard\"\nrectangle_m = [0.0, -300.0, 200.0, 100.0, 0.0]\n"
        "texture = \"near\"\n";
    write_text(folder.path / "scene.toml", with(with(small_scene(), "material = \"grass\"",
                                                     "material = \"grass\"\ntexture = \"wide\""),
                                                "\"concrete_wall\"", "\"old_wall\"") +
                                               tables);
    const Prepared p = prepare(read_scene(folder.path / "scene.toml"));
    const TextureLevels& texture_levels = p.world.texture_levels;
    double yard = 0.0;
    std::size_t bare = 0;
    for (std::size_t f = 0; f < p.world.facets.size(); ++f) {
        const std::string& object =
            p.world.objects[static_cast<std::size_t>(p.world.facets.object[f])];
        const std::string material = p.scene.materials[p.world.facets.material[f]].name;
        const TextureLevels::OfFacet& of_facet = texture_levels.of_facet[f];
        bare += (of_facet.skin != no_skin) != (object == "ground" || material == "old_wall");
        if (of_facet.skin == no_skin) continue;
        const auto& skin = texture_levels.skin[of_facet.skin];
        const double deviation = std::get<ClutterTexture>(*skin.texture).deviation;
        if (deviation == 0.03) {
            yard += p.world.facets.area[f] * p.world.facets.normal[f].z();
        }
        bare += (material == "old_wall") !=
                (p.scene.materials[skin.material[0]].name == "old_wall (emissivity 0.74)");
    }
    CHECK(bare == 0);
    CHECK(yard == Approx(200.0 * 100.0).epsilon(2e-3));
    CHECK(std::count_if(p.notes.begin(), p.notes.end(), [](const std::string& note) {
              return note.find("texture \"rust\"") == 0;
          }) == 1);
}
