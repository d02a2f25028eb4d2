#include "terrain/objects/facing.hpp"

#include <catch2/catch.hpp>

#include "tests/support/read_mesh.hpp"

using namespace diurna;
using namespace read_mesh;

namespace {

const PrivateTempFolder private_temp_folder;

}  // namespace

TEST_CASE("each closed piece faces outward, whichever way it is wound", "[terrain][facing]") {
    const bool first = GENERATE(false, true), second = GENERATE(false, true);
    MeshFile mesh = mesh_of({{{0, 0, 0}, {2, 2, 1.5}, first}, {{3, 0, 0}, {1, 1, 1}, second}});
    const Facing found = turn_outward(mesh, one_material(mesh));
    CHECK(volume(mesh) == Approx(6.0 + 1.0));
    CHECK(found.closed == 2);
    CHECK(found.turned == std::size_t(first) + std::size_t(second));
    CHECK(found.triangles == 0);
    CHECK(facing_note(found).empty() == (!first && !second));
}

TEST_CASE("triangles that face otherwise than their neighbours are turned", "[terrain][facing]") {
    MeshFile mesh = mesh_of({{{0, 0, 0}, {2, 2, 1.5}}});
    for (const std::size_t t : {0, 7, 8}) std::swap(mesh.triangle[t][0], mesh.triangle[t][1]);
    const Facing found = turn_outward(mesh, one_material(mesh));
    CHECK(volume(mesh) == Approx(6.0));
    CHECK(found.turned == 0);
    CHECK(found.triangles == 3);
}

TEST_CASE("a cavity faces inwards and a body in it outwards", "[terrain][facing]") {
    const int wound = GENERATE(range(0, 8));
    const Box shell{{0, 0, 0}, {4, 4, 4}, (wound & 1) != 0},
        cavity{{0.5, 0.5, 0.5}, {3, 3, 3}, (wound & 2) != 0},
        core{{1, 1, 1}, {1, 1, 1}, (wound & 4) != 0};
    MeshFile mesh = mesh_of({core, shell, cavity});
    turn_outward(mesh, one_material(mesh));
    CHECK(volume(mesh) == Approx(64.0 - 27.0 + 1.0));
}

// A plant in a box of glass is no cavity of the glass.
TEST_CASE("a body of another material keeps its sense relative to what encloses it",
          "[terrain][facing]") {
    const bool reversed = GENERATE(false, true), hollow = GENERATE(false, true);
    MeshFile mesh =
        mesh_of({{{0, 0, 0}, {4, 4, 4}, reversed}, {{1, 1, 1}, {1, 1, 1}, reversed != hollow}});
    const std::vector<std::string> material{"glass", "leaves"};
    turn_outward(mesh, material);
    CHECK(volume(mesh) == Approx(64.0 + (hollow ? -1.0 : 1.0)));
}

TEST_CASE("two rooms that share a wall face outward", "[terrain][facing]") {
    const bool first = GENERATE(false, true);
    MeshFile mesh = mesh_of({{{0, 0, 0}, {1, 1, 1}, first}, {{1, 0, 0}, {2, 1, 1}, !first}});
    // The wall between them, of four vertices that both have, is within the body: it goes.
    for (auto& corner : mesh.triangle) {
        for (std::uint32_t& v : corner) {
            v = static_cast<std::uint32_t>(
                std::find(mesh.vertex.begin(), mesh.vertex.end(), mesh.vertex[v]) -
                mesh.vertex.begin());
        }
    }
    weld_faces(mesh, one_material(mesh));
    REQUIRE(mesh.triangle.size() == 20);
    turn_outward(mesh, one_material(mesh));
    CHECK(volume(mesh) == Approx(3.0));
}

TEST_CASE("a sheet stays as its file has it", "[terrain][facing]") {
    MeshFile mesh = mesh_of({{{0, 0, 0}, {1, 1, 1}, true}});
    mesh.triangle.resize(10);
    mesh.part_of.resize(10);
    const auto before = mesh.triangle;
    CHECK(turn_outward(mesh, one_material(mesh)).closed == 0);
    CHECK(mesh.triangle == before);
}
