#include "terrain/objects/welded_faces.hpp"

#include <catch2/catch.hpp>

#include "terrain/objects/open_pieces.hpp"

using namespace diurna;

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// A square of two triangles, then `more` of a second part.
MeshFile square_and(std::vector<Corners> more) {
    MeshFile mesh{.vertex = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}},
                  .triangle = {{0, 1, 2}, {0, 2, 3}},
                  .part_of = {0, 0},
                  .part = {{"a", ""}, {"b", ""}}};
    for (const Corners& corner : more) {
        mesh.triangle.push_back(corner);
        mesh.part_of.push_back(1);
    }
    return mesh;
}

bool is_open(const MeshFile& mesh) {
    ObjectMesh placed;
    for (const auto& v : mesh.vertex) placed.vertex.push_back(v.cast<float>());
    placed.triangle = mesh.triangle;
    placed.material.resize(mesh.triangle.size());
    for (const std::uint8_t open : open_pieces(placed)) {
        if (open == 0) return false;
    }
    return true;
}

const std::vector<std::string> alike = {"tin", "tin"}, unlike = {"tin", "cloth"};

}  // namespace

TEST_CASE("a sheet written twice is one sheet, whichever way the copy faces",
          "[terrain][objects]") {
    const std::vector<Corners> copy = GENERATE(std::vector<Corners>{{1, 2, 0}, {0, 2, 3}},
                                               std::vector<Corners>{{0, 2, 1}, {3, 2, 0}});
    MeshFile mesh = square_and(copy);
    CHECK_FALSE(is_open(mesh));
    const WeldedFaces found = weld_faces(mesh, alike);
    CHECK(found.removed == 2);
    CHECK(mesh.triangle == std::vector<Corners>{{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.part_of == std::vector<std::uint16_t>{0, 0});
    CHECK(is_open(mesh));
}

TEST_CASE("faces of two materials in one place are told", "[terrain][objects]") {
    MeshFile same_way = square_and({{2, 0, 1}});
    const WeldedFaces contested = weld_faces(same_way, unlike);
    REQUIRE(contested.contested);
    CHECK(*contested.contested == std::array<std::uint32_t, 2>{0, 1});

    MeshFile reversed = square_and({{0, 2, 1}});
    const WeldedFaces kept = weld_faces(reversed, unlike);
    CHECK_FALSE(kept.contested);
    CHECK(kept.back_to_back == 1);
    CHECK(kept.removed == 0);
    CHECK(reversed.triangle.size() == 3);
}

TEST_CASE("triangles whose corners lie on a line are left out", "[terrain][objects]") {
    MeshFile mesh = square_and({{0, 1, 4}});
    const WeldedFaces found = weld_faces(mesh, alike);
    CHECK(found.flat == 1);
    CHECK(mesh.triangle.size() == 2);
}
