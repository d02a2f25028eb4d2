#include "scenes/products/export/reshade.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "render/picture/exr.hpp"
#include "tests/support/black_plain.hpp"
#include "tests/support/folder_contents.hpp"

// A changed surface in a picture: by the sum on paper, and against the whole run of the changed
// scene.

using namespace diurna;

namespace {

namespace fs = std::filesystem;

/// ∫ B(λ, T) dλ from 8 to 12 µm by midpoints, from the constants of CODATA 2018.
double black(double kelvin) {
    constexpr double first = 1.191042972e8, second = 1.438776877e4;  // 2hc² [W µm⁴/m²/sr], hc/k
    constexpr int steps = 4000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double um = 8.0 + (i + 0.5) * 4.0 / steps;
        sum += first / (std::pow(um, 5) * std::expm1(second / (um * kelvin))) * 4.0 / steps;
    }
    return sum;
}

constexpr double warm = 300.0, down = 22.0;  // [K], [W m⁻² sr⁻¹]

/// Two pixels of 8-12 µm: each half a grey surface of facet 0, half one of facet 1.
Frame two_pixels(double emissivity) {
    Frame frame;
    frame.width = 2;
    frame.height = 1;
    frame.observer = "eye";
    const auto add = [&](const std::string& name, double value) {
        frame.planes.push_back({name, "1", {float(value), float(value)}});
    };
    for (int k = 1; k <= 2; ++k) {
        const auto plane = [&](const std::string& what, double value) {
            add(fmt::format("{}_{}", what, k), value);
        };
        const auto of_band = [&](const std::string& what, double value) {
            add(fmt::format("{}_{}.8-12", what, k), value);
        };
        plane("weight", 0.5);
        plane("facet", k - 1);
        plane("temperature", warm);
        plane("sun_fraction", 0.0);
        plane("cosine_sun", 0.0);
        plane("sky_view", 1.0);
        of_band("black", black(warm));
        of_band("emissivity", emissivity);
        of_band("sunlight", 0.0);
        of_band("skylight", down);
        of_band("surroundings", 0.0);
        for (const char* light : {"sun", "sky", "surroundings"}) {
            of_band(std::string("reflectance_") + light, 1.0 - emissivity);
            of_band(std::string("transmittance_") + light, 0.9);
        }
        of_band("transmittance", 0.9);
    }
    add("unlisted", 0.0);
    add("path.8-12", 1.5);
    add("temperature", warm);
    add("facet", 0.0);
    add("radiance.8-12", 0.9 * (emissivity * black(warm) + (1.0 - emissivity) * down) + 1.5);
    add("apparent_temperature.8-12", 0.0);
    return frame;
}

const ChangedFacets second{.of_object = {0, 1}, .warmer = {}};

double radiance(const ReshadedFrame& found) {
    return double(found.frame["radiance.8-12"].pixel[0]);
}

int shell(const std::string& command) {
    return WEXITSTATUS(std::system((command + " 2>&1").c_str()));
}

}  // namespace

TEST_CASE("a grey surface sends eps B(T) + (1 - eps) L_down, whatever the picture had",
          "[scenes][reshade]") {
    const Frame given = two_pixels(0.9);
    const double before = 0.9 * black(warm) + 0.1 * down;
    for (const double next : {0.0, 0.35, 0.9, 1.0}) {
        CAPTURE(next);
        const ReshadedFrame found = reshade(given, second, {.emissivity = next});
        const double after = next * black(warm) + (1.0 - next) * down;
        CHECK(radiance(found) == Approx(0.9 * 0.5 * (before + after) + 1.5).epsilon(2e-6));
        CHECK(found.pixels == 2);
        CHECK(found.summed == 2);
        CHECK(found.sum_worst < 1e-3);
    }
    // Warmer, by its own Planck curve.
    const ReshadedFrame hot = reshade(given, second, {.warmer = 25.0});
    const double after = 0.9 * black(warm + 25.0) + 0.1 * down;
    CHECK(radiance(hot) == Approx(0.9 * 0.5 * (before + after) + 1.5).epsilon(2e-6));
    CHECK(hot.frame["temperature_2"].pixel[0] == 325.0f);
    CHECK(hot.frame["temperature_1"].pixel[0] == 300.0f);
    // Heat of all facets: the other surface is warmer as well.
    const ReshadedFrame both =
        reshade(given, {.of_object = {0, 1}, .warmer = {2.0f, -1.0f}}, {.emissivity = 0.5});
    const double first = 0.9 * black(warm + 2.0) + 0.1 * down;
    const double other = 0.5 * black(warm - 1.0) + 0.5 * down;
    CHECK(radiance(both) == Approx(0.9 * 0.5 * (first + other) + 1.5).epsilon(2e-6));
}

TEST_CASE("a wrong sum is reported as error, an unlisted surface as such", "[scenes][reshade]") {
    Frame given = two_pixels(0.9);
    for (Plane& plane : given.planes) {
        if (plane.name == "path.8-12") plane.pixel[1] += 0.05f;
        if (plane.name == "unlisted") plane.pixel[0] = 0.1f;
    }
    const ReshadedFrame found = reshade(given, second, {.emissivity = 0.5});
    CHECK(found.unlisted == 1);
    CHECK(found.summed == 1);
    const double slope = (black(300.5) - black(299.5));  // near enough at some 297 K
    CHECK(found.sum_worst == Approx(0.05 / slope).epsilon(0.1));
    // The estimate of heat: less emission to a colder sky warms. 350 W/m2 from the sky.
    given.attributes["sky.longwave_down_W_m2"] = "350.0";
    const double lost = 5.670374419e-8 * std::pow(warm, 4) - 350.0;
    const double film = 10.0 + 4.0 * 0.5 * 5.670374419e-8 * std::pow(warm, 3);
    CHECK(reshade(given, second, {.emissivity = 0.5}).heat_estimate ==
          Approx(0.4 * lost / film).epsilon(1e-3));
}

TEST_CASE("a picture without surfaces, or of a named band, is refused", "[scenes][reshade]") {
    Frame bare = two_pixels(0.9);
    std::erase_if(bare.planes, [](const Plane& plane) { return plane.name == "weight_1"; });
    CHECK_THROWS_AS(reshade(bare, second, {.emissivity = 0.5}), InputError);
    Frame named = two_pixels(0.9);
    for (Plane& plane : named.planes) {
        if (plane.name == "radiance.8-12") plane.name = "radiance.seeker";
    }
    CHECK_THROWS_AS(reshade(named, second, {.emissivity = 0.5}), InputError);
}

TEST_CASE("a reshaded picture is that of the changed scene's own run", "[scenes][reshade]") {
    const ScratchFolder folder("reshade");
    std::string text = black_plain(R"(
[material.paint]
like = "black"
emissivity = 0.9
albedo = 0.5
)" + plate_below_drone("paint", "[\"8-12\"]"));
    text = with(text, "profile = \"vacuum\"", "visibility_km = 23.0");
    text = with(text, "samples = 4", "samples = 4\nsurfaces = 12\nterms = true");
    lay(folder, text);
    const std::string scene = "'" + (folder.path / "scene.toml").string() + "' --allow-outside";
    const auto at = [&](const char* name) { return "'" + (folder.path / name).string() + "'"; };
    const std::string program = "'" DIURNA_BINARY "' ";
    const std::string changed = " --set material.paint.emissivity=0.6";
    REQUIRE(shell(program + "run " + scene + " --fresh --out " + at("base") + " >/dev/null") == 0);
    REQUIRE(shell(program + "run " + scene + changed + " --fresh --out " + at("whole") +
                  " >/dev/null") == 0);
    // In the band, of a spectrum whose broadband emissivity is 0.6.
    const Frame one = read_exr(folder.path / "whole/frames/drone_8-12_20260715T040000Z.exr");
    const std::size_t middle = one.pixels() / 2 + std::size_t(one.width) / 2;
    const std::string paint = fmt::format(" --of plate --emissivity {:.7f} --out ",
                                          one["emissivity_1.8-12"].pixel[middle]);
    REQUIRE(shell(program + "reshade " + at("base") + " --heat " + at("whole/temperatures.nc") +
                  paint + at("new") + " >" + at("new.txt")) == 0);
    REQUIRE(shell(program + "reshade " + at("base") + paint + at("cold") + " >" + at("cold.txt")) ==
            0);
    INFO(read_text(folder.path / "new.txt"));
    CHECK(read_text(folder.path / "cold.txt").find("effect on heat not included: about +") !=
          std::string::npos);
    std::size_t pictures = 0;
    for (const auto& entry : fs::directory_iterator(folder.path / "whole/frames")) {
        const std::string name = entry.path().filename();
        if (entry.path().extension() != ".exr") continue;
        CAPTURE(name);
        const Frame whole = read_exr(entry.path()), made = read_exr(folder.path / "new" / name);
        double worst = 0.0, moved = 0.0;
        const Frame base = read_exr(folder.path / "base/frames" / name);
        for (std::size_t p = 0; p < whole.pixels(); ++p) {
            const auto kelvin = [&](const Frame& frame) {
                return double(frame["apparent_temperature.8-12"].pixel[p]);
            };
            worst = std::max(worst, std::abs(kelvin(made) - kelvin(whole)));
            moved = std::max(moved, std::abs(kelvin(base) - kelvin(whole)));
        }
        CHECK(worst < 0.05);
        CHECK(moved > 1.0);
        ++pictures;
    }
    CHECK(pictures >= 4);
    // The folder of an earlier one is used again; no other that holds anything.
    CHECK(shell(program + "reshade " + at("base") + paint + at("new") + " >/dev/null") == 0);
    fs::create_directories(folder.path / "mine");
    std::ofstream(folder.path / "mine/notes.txt") << "mine";
    for (const std::string name :
         {"base", "base/frames", "base/images", "whole", "whole/frames", "mine"}) {
        CAPTURE(name);
        const fs::path out = folder.path / name;
        const auto before = contents(out);
        CHECK(shell(program + "reshade " + at("base") + paint + at(name.c_str()) + " >/dev/null") ==
              2);
        CHECK(contents(out) == before);
    }
    // Mistakes: one line, nothing written.
    CHECK(shell(program + "reshade " + at("base") + " --of plote --warmer 1 --out " + at("none") +
                " >/dev/null") == 2);
    CHECK(shell(program + "reshade " + at("base") + " --of plate --out " + at("none") +
                " >/dev/null") == 2);
    CHECK_FALSE(fs::exists(folder.path / "none"));
}
