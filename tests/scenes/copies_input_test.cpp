#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/world/copy_ground.hpp"
#include "tests/support/copied_crates.hpp"

// What copies may be reported, and the ground that is made fine for them.

using namespace diurna;
using namespace copied_crates;
namespace fs = std::filesystem;

namespace {

std::string mistakes_of(const fs::path& folder, const std::string& objects) {
    std::string all;
    try {
        prepare(read_scene(written(folder, objects)));
    } catch (const InputError& error) {
        for (const Mistake& mistake : error.mistakes()) all += mistake.line() + "\n";
    }
    return all;
}

}  // namespace

TEST_CASE("the ground of many copies is made fine once", "[scenes][copies]") {
    const ScratchFolder folder("copies_ground");
    const auto ground = [&](const std::string& objects) {
        const Prepared built = prepare(read_scene(written(folder.path, objects)));
        // Nothing skipped and nothing twice.
        double area = 0.0;
        for (std::size_t f = 0; f < built.world.ground_facets; ++f) {
            area += double{built.world.facets.area[f]} * built.world.facets.normal[f].z();
        }
        return std::pair{built.world.ground_facets, area};
    };
    const auto [copied, area] = ground(copies(alike_within));
    const auto [built_out, same] = ground(apart(stands));
    const auto [none, plain] = ground("");
    CAPTURE(copied, built_out, none);
    // Ground is filled once where patches lie over one another, those of copies and those of single
    // objects; tiles have two triangles to each square of three quarters of the edge, and some at
    // borders.
    CHECK(double(copied) == Approx(double(built_out)).epsilon(0.05));
    const Scene scene = read_scene(written(folder.path, copies(alike_within)));
    double squares = 0.0;
    for (const GroundPatch& patch : patches_round(scene.terrain.objects)) {
        double twice = 0.0;
        for (std::size_t i = 0; i < patch.ring.size(); ++i) {
            const Eigen::Vector2d &a = patch.ring[i], &b = patch.ring[(i + 1) % patch.ring.size()];
            twice += a.x() * b.y() - a.y() * b.x();
        }
        squares += 0.5 * twice / std::pow(0.75 * patch.largest_edge, 2);
    }
    CHECK(double(copied - none) == Approx(2.0 * squares).epsilon(0.2));
    CHECK(copied > none + 1000);
    CHECK(area == Approx(plain).epsilon(1e-5));
    CHECK(same == Approx(plain).epsilon(1e-5));
}

TEST_CASE("what copies cannot have is refused in one line", "[scenes][copies][mistakes]") {
    const ScratchFolder folder("copies_mistakes");
    const auto reported = [&](const std::string& keys) {
        const std::string all =
            mistakes_of(folder.path, "[[object]]\nname = \"crate\"\n" + about_crate + keys);
        CAPTURE(all);
        CHECK(std::count(all.begin(), all.end(), '\n') == 1);
        return all;
    };
    const auto has = [](const std::string& text, const std::string& part) {
        CAPTURE(text, part);
        CHECK(text.find(part) != std::string::npos);
    };
    has(reported("copies = [[0.0, 0.0, 0.0]]\nplace_m = [0.0, 0.0]"),
        "place_m: cannot be combined with copies");
    has(reported("copies = [[0.0, 0.0, 500.0]]"), "found heading_deg 500");
    const std::string turned = reported("copies = [[0.0, 0.0, 500.0]]");
    CHECK(turned.find("toml:") == turned.rfind("toml:"));
    has(reported("copies = [[0.0, 0.0]]"), "copies");
    has(reported("copies = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 0.0, 90.0]]"),
        "copies: two copies have the place east 0 m, north 0 m");
    has(reported("copies = [[9000.0, 0.0, 0.0]]"), "crate_0001");
    has(reported("place_m = [0.0, 0.0]\ncopies_alike_K = 1.0"), "copies_alike_K: needs copies");

    has(reported("copies_file = \"none.csv\""), "no such file");
    has(reported("copies = [[0.0, 0.0, 0.0]]\n[[object.part]]\nname = \"*\"\n[[object.contact]]\n"
                 "between = [\"*\", \"ground\"]\nconductance_W_m2K = 10.0"),
        "contact with the ground");
    const std::string texture =
        "\n[[texture]]\nname = \"worn\"\nstd = 0.01\ncorrelation_length_m = 1.0\n";
    has(reported("copies = [[0.0, 0.0, 0.0]]\ntexture = \"worn\"" + texture),
        "texture: not available for an");
    has(mistakes_of(folder.path, "[[object]]\nname = \"crate\"\ncopies = [[0.0, 0.0, 0.0]]\n" +
                                     with(about_crate, "painted_sheet", "rusty") +
                                     "[material.rusty]\nlike = \"painted_sheet\"\n"
                                     "texture = \"worn\"" +
                                     texture),
        "which has a texture");
    write_text(folder.path / "park.csv",
               "# a yard\neast_m,north_m,heading_deg\n1,2,3\n\n4,\"5\",six\n");
    has(reported("copies_file = \"park.csv\""), "park.csv:5:");
    write_text(folder.path / "park.csv", "east_m,nord_m,heading_deg\n1,2,3\n");
    has(reported("copies_file = \"park.csv\""), "north_m");
    write_text(folder.path / "park.csv", "east_m,north_m,heading_deg,colour\n0,0,0,3\n");
    has(reported("copies_file = \"park.csv\""), "unknown column 'colour'");
    write_text(folder.path / "park.csv", "east_m,north_m,heading_deg\n5,5,0\n0,0,0\n5,5,90\n");
    has(reported("copies_file = \"park.csv\""), "park.csv:4:3");
    write_text(folder.path / "park.csv", "east_m,north_m,heading_deg\n0,0,0\n10,0,90\n");
    CHECK(mistakes_of(folder.path,
                      "[[object]]\nname = \"crate\"\n" + about_crate + "copies_file = \"park.csv\"")
              .empty());
    has(mistakes_of(folder.path, "[[object]]\nname = \"crate_0002\"\nplace_m = [30.0, 0.0]\n" +
                                     about_crate + "[[object]]\nname = \"crate\"\n" + about_crate +
                                     "copies_file = \"park.csv\""),
        "crate_0002");
}

// Edges of 0.5 m that reach into each other are reported; things that touch are not.
TEST_CASE("copies that overlap are reported", "[scenes][copies]") {
    const ScratchFolder folder("copies_overlap");
    const auto noted = [&](const std::string& places) {
        const Prepared built = prepare(read_scene(
            written(folder.path, "[[object]]\nname = \"crate\"\n" + about_crate + places)));
        return std::count_if(built.notes.begin(), built.notes.end(), [](const std::string& note) {
            return note.find("intersect") != std::string::npos;
        });
    };
    CHECK(noted("copies = [[0.0, 0.0, 0.0], [0.3, 0.0, 0.0]]") == 1);
    CHECK(noted("copies = [[0.0, 0.0, 0.0], [30.0, 0.0, 0.0]]") == 0);
}
