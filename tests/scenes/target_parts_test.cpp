#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"
#include "scenes/job/world/targets.hpp"
#include "tests/support/target_scene.hpp"

using namespace diurna;
using namespace diurna::testing::target_scene;
namespace over_plain = diurna::testing::over_plain;

TEST_CASE("a part takes heat from the one that it lies on", "[scenes][target]") {
    // A block on a box's lid held at 340 K, 5 mm apart, 20 W/m2K between them; the block's foot
    // loses 10 W/m2K to 290 K at its inner face, and nothing outside, being covered: (20 340 + 10
    // 290) / 30 = 323.3 K. The uncovered part of the lid is as hot as it is held.
    std::string mesh = box(4, 0.5) + "g upper\n";
    mesh += over_plain::block(-1.0, 1.0, -1.0, 1.0, 1.0);
    const std::string foot = "g upper\n";
    std::size_t at = mesh.find(foot);
    // Its lowest corners half a metre and 5 mm up; its foot a group of its own.
    for (int i = 0; i < 4; ++i) {
        at = mesh.find(" 0\n", at);
        mesh.replace(at, 3, " 0.505\n");
    }
    const std::string down = "f -5 -6 -7 -8\n";
    mesh.replace(mesh.rfind(down), down.size(), "");
    mesh += "g foot\n" + down;
    const over_plain::Given given{
        .mesh = mesh, .height = 2.0, .albedo = 1.0, .black = 0.0, .ground_edge = 5.0};
    const Solved on = solved(given, R"([[object.part]]
name = "*"
[[object.part]]
name = "lid"
welded = false
temperature_K = 340.0
[[object.part]]
name = "foot"
welded = false
[[object.lump]]
name = "sink"
temperature_K = 290.0
[[object.link]]
between = ["sink", "foot"]
film_W_m2K = 10.0
[[object.contact]]
between = ["foot", "lid"]
conductance_W_m2K = 20.0
)");
    CHECK(on.kelvin("12:00", "foot") == Approx(970.0 / 3.0).margin(0.05));
    CHECK(on.kelvin("12:00", "lid") == Approx(340.0).margin(0.05));
    CHECK(on.result.report.converged);
}

TEST_CASE("heat is conducted over the edge of a sheet", "[scenes][target]") {
    // Lid, sides and floor of one sheet, 2 mm of 200 W/mK, 10 W/m2K outside: m = sqrt(10 / 0.4) = 5
    // /m. The lid gets 200 W/m2; all of it leaves somewhere: sum of A (T - 290) = 20 A_lid. Over
    // its edge, a fold half a fin deep on either side, go 10 K 0.4 W/K 5 /m = 20 W/m on 8 m, but
    // for the corners: 160 W, of which the sides lose tanh(2.5) / ... nearly all: 4 K over their 4
    // m2.
    const over_plain::Given given{.mesh = box(2, 0.5),
                                  .height = 2.0,
                                  .albedo = 1.0,
                                  .black = 0.0,
                                  .layer = "thickness_m = 0.002, conductivity_W_mK = 200.0",
                                  .ground_edge = 5.0};
    const Solved on = solved(given, R"([[object.part]]
name = "lid"
heat_W_m2 = 200.0
[[object.part]]
name = "*"
)",
                             12.0, 0.15);
    const double lid = on.kelvin("11:00", "lid") - 290.0,
                 sides = on.kelvin("11:00", "sides") - 290.0,
                 floor = on.kelvin("11:00", "floor") - 290.0;
    CAPTURE(lid, sides, floor);
    CHECK(4.0 * lid + 4.0 * sides + 4.0 * floor == Approx(80.0).epsilon(1e-4));
    CHECK(sides + floor == Approx(4.0).epsilon(0.1));
}

TEST_CASE("a fin begins where the part ends that it is welded to", "[scenes][target]") {
    // The four sides of a metre's height stand on a floor held at 340 K in air of 290 K: each a fin
    // of the sheet above, m = 5 /m, without flow over its top. Its mean is 290 + 50 tanh(5) / 5 =
    // 299.999 K (Incropera 3.6, case B), however large its facets: a floor that is held at every
    // place is so at its edge, and takes no half facet of the way.
    const over_plain::Given given{.mesh = box(1, 1.0),
                                  .height = 2.0,
                                  .albedo = 1.0,
                                  .black = 0.0,
                                  .layer = "thickness_m = 0.002, conductivity_W_mK = 200.0",
                                  .ground_edge = 5.0};
    const std::string parts = R"([[object.part]]
name = "floor"
temperature_K = 340.0
[[object.part]]
name = "lid"
welded = false
[[object.part]]
name = "sides"
)";
    const double mean = 290.0 + 50.0 * std::tanh(5.0) / 5.0;
    const double fine = solved(given, parts, 12.0, 0.05).kelvin("11:00", "sides") - mean;
    const double middle = solved(given, parts, 12.0, 0.1).kelvin("11:00", "sides") - mean;
    const double coarse = solved(given, parts, 12.0, 0.2).kelvin("11:00", "sides") - mean;
    CAPTURE(fine, middle, coarse);
    // A quarter of the error at half the edge: of second order.
    CHECK(std::abs(coarse) < 0.5);
    CHECK(std::abs(middle) < 0.15);
    CHECK(std::abs(fine) < 0.05);
}

TEST_CASE("mistakes in a target are reported with their place", "[scenes][target][input]") {
    const ScratchFolder folder("mistakes");
    over_plain::write_scene(folder.path, {.mesh = box(2, 0.5)});
    const std::string plain = read_text(folder.path / "scene.toml");
    const auto reported = [&](const std::string& tables) {
        std::string text = plain;
        const std::string end = "material = \"sheet\"\n";
        text.insert(text.rfind(end) + end.size(), tables);
        write_text(folder.path / "scene.toml", text);
        std::string all;
        try {
            read_scene(folder.path / "scene.toml");
        } catch (const InputError& error) {
            for (const Mistake& mistake : error.mistakes()) all += mistake.line() + "\n";
        }
        return all;
    };
    using Catch::Matchers::Contains;
    CHECK(reported("[[object.part]]\nname = \"lid\"\n").empty());
    CHECK_THAT(
        reported("[[object.part]]\nname = \"lit\"\n"),
        Contains("no part \"lit\" in the mesh, which has lid") && Contains("did you mean 'lid'?"));
    CHECK_THAT(reported("[[object.part]]\nname = \"lid\"\ninside = \"hall\"\n"),
               Contains("'hall', which is not an enclosure"));
    CHECK_THAT(
        reported("[[object.part]]\nname = \"lid\"\nhours = [\"5 till 7\"]\n"),
        Contains("hours: found '5 till 7', expected hours and a share such as 05:30-06:10 0.3"));
    CHECK_THAT(reported("[[object.part]]\nname = \"lid\"\n[[object.link]]\nbetween = [\"lid\", "
                        "\"engin\"]\nconductance_W_K = 1\n[[object.lump]]\nname = \"engine\"\n"),
               Contains("unknown 'engin' in this object") && Contains("did you mean 'engine'?"));
    CHECK_THAT(reported("[[object.lump]]\nname = \"engine\"\n"),
               Contains("object.part: missing, expected at least one"));
    const std::string lid = "[[object.part]]\nname = \"lid\"\n";
    CHECK_THAT(reported(lid + "runs = true\n"), Contains("runs: has no effect without heat"));
    CHECK_THAT(reported(lid + "[[object.lump]]\nname = \"oil\"\ntemperature_K = 350\n"
                              "heat_capacity_J_K = 1000\n"),
               Contains("heat_capacity_J_K: has no effect on a lump"));
    CHECK_THAT(reported(lid + "[[object.lump]]\nname = \"ground\"\n"),
               Contains("'ground' is already in use"));
    const std::string on_ground = "[[object.contact]]\nconductance_W_m2K = 50\nbetween = ";
    CHECK_THAT(reported(lid + on_ground + "[\"lid\", \"ground\"]\n" + on_ground +
                        "[\"ground\", \"lid\"]\n"),
               Contains("between: connects 'lid' and 'ground' as"));
    CHECK_THAT(reported("part_file = \"none.toml\"\n"), Contains("part_file: no such file"));
    write_text(folder.path / "mesh.parts.toml", "[[part]]\nname = \"lid\"\nheat = 5\n");
    CHECK_THAT(reported(""), Contains("mesh.parts.toml:3:1: part.heat: unknown key"));
}
